//! How much memory a build takes.

use super::{BuildError, BuildOptions, SahBuilder, Strategy};

impl BuildOptions {
    /// About how many bytes a build over so many triangles takes at its peak, trees included but not
    /// the mesh: what was measured of the most expensive of seven ordinary scenes, and a third more
    /// (docs/decisions/0009).
    ///
    /// Triangles that no plane separates well, such as long needles in all directions, are listed
    /// by many leaves and may take twice as much, as may leaves smaller than those of the presets
    /// or of [`for_strategy`](Self::for_strategy).
    ///
    /// ```
    /// use kdray::{BuildOptions, Preset};
    /// let needed = BuildOptions::preset(Preset::Fast).peak_bytes(50_000_000);
    /// assert!(needed < 16 << 30, "16 GiB will do");
    /// ```
    pub fn peak_bytes(&self, count: usize) -> u64 {
        /// What threads work in, whatever the number of triangles.
        const BESIDES: u64 = 1 << 20;
        let each = match (self.strategy, self.sah_builder) {
            (Strategy::Sah, SahBuilder::Binned { .. }) => BINNED,
            (Strategy::Sah, SahBuilder::Sweep) => SWEPT,
            _ => LECTURE,
        };
        (count as u64).saturating_mul(each).saturating_add(BESIDES)
    }

    /// Whether `needed` bytes are within the limit.
    pub(crate) fn check_memory(&self, needed: u64) -> Result<(), BuildError> {
        match self.memory_limit {
            Some(limit) if needed > limit => Err(BuildError::Memory { needed, limit }),
            _ => Ok(()),
        }
    }
}

/// Bytes a triangle by bins: the wide tree at the end is the most of it.
const BINNED: u64 = 270;

/// By the sweep, with lists of bounds sorted on each axis.
const SWEPT: u64 = 400;

/// Without either, but with trees of more references.
const LECTURE: u64 = 280;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build::Preset;
    use crate::{KdTree, Scene, TriangleMesh};

    #[test]
    fn what_does_not_fit_is_refused_beforehand() {
        let mesh = TriangleMesh::from_soup([[[0.0; 3], [1.0; 3], [0.0, 1.0, 0.0]]; 100]).unwrap();
        let options = BuildOptions::preset(Preset::Fast);
        let needed = options.peak_bytes(100);
        let build = |limit| {
            KdTree::build(&mesh, &BuildOptions { memory_limit: Some(limit), ..options }).map(|_| ())
        };
        assert_eq!(build(needed), Ok(()));
        let limit = needed - 1;
        assert_eq!(build(limit), Err(BuildError::Memory { needed, limit }));
        let message = build(limit).unwrap_err().to_string();
        assert!(message.contains("raise the limit"), "{message}");
    }

    #[test]
    fn a_tree_of_more_references_than_expected_is_refused_before_it_is_made_wide() {
        // Needles along the diagonals of a cube: no plane separates many of them.
        let needle = |i: u32| {
            let [x, y] = [i % 50, i / 50].map(|k| k as f32 / 50.0);
            [[x, y, 0.0], [1.0 - y, x, 1.0], [x, y, 0.001]]
        };
        let mesh = TriangleMesh::from_soup((0..2500).map(needle)).unwrap();
        let options = BuildOptions { leaf_size: 1, ..BuildOptions::preset(Preset::Best) };
        let options = BuildOptions { prune: false, ..options };
        let limit = options.peak_bytes(2500);
        let refused = Scene::build(mesh, &BuildOptions { memory_limit: Some(limit), ..options });
        assert!(matches!(refused, Err(BuildError::Memory { needed, .. }) if needed > limit));
    }

    #[test]
    fn the_sweep_is_estimated_higher_than_bins() {
        let bytes = |preset| BuildOptions::preset(preset).peak_bytes(1_000_000);
        assert!(bytes(Preset::Best) > bytes(Preset::Balanced));
        assert_eq!(BuildOptions::default().peak_bytes(usize::MAX), u64::MAX);
    }
}
