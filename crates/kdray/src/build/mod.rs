//! From primitives to a tree: the steps of the founding lecture (S6), written once.
//!
//! The steps ask a strategy for one thing only, the plane: [`Strategy::Middle`],
//! [`Strategy::Median`] and [`Strategy::RoundRobin`] find it by a rule, [`Strategy::Sah`] by least
//! cost under a [`CostModel`], from candidates that [`SahBuilder`] says how to count. A [`Preset`]
//! is a choice of all that for a purpose.
//!
//! The tree is the same bit for bit on every run and for any number of threads. What a build may
//! take is bounded: leaves list at most [`BuildOptions::reference_quota`] entries together, and
//! what is expected to take more memory than [`BuildOptions::memory_limit`] is refused.

mod distribute;
mod error;
mod median;
mod memory;
mod middle;
mod options;
pub(crate) mod parallel;
mod plane;
mod preset;
pub(crate) mod progress;
mod reference;
mod round_robin;
mod sah;
mod steps;
mod strategy;
mod subtree;

pub use crate::tree::{CostModel, CostModelError, Termination};
pub use error::BuildError;
pub use options::{BuildOptions, SahBuilder};
pub use preset::{Preset, UnknownPreset};
pub use progress::BuildProgress;
pub use strategy::{Strategy, UnknownStrategy};

use crate::geometry::Aabb;
use crate::primitives::Primitives;
use crate::tree::KdTree;
use progress::Progress;
use std::ops::ControlFlow;
use steps::Build;

impl<const K: usize> KdTree<K> {
    /// Builds the tree over `primitives`. K is 1, 2 or 3.
    ///
    /// Without primitives the tree is one empty leaf. A primitive whose bounds are empty
    /// (`min > max`, but finite) is nowhere, and no leaf lists it.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build(
        primitives: &impl Primitives<K>,
        options: &BuildOptions,
    ) -> Result<Self, BuildError> {
        Self::build_with_progress(primitives, options, &|_| ControlFlow::Continue(()))
    }

    /// Builds the tree, and tells `progress` now and then how far it is, from any thread, one call
    /// at a time; [`ControlFlow::Break`] stops the build.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build_with_progress(
        primitives: &impl Primitives<K>,
        options: &BuildOptions,
        progress: &(dyn Fn(BuildProgress) -> ControlFlow<()> + Sync),
    ) -> Result<Self, BuildError> {
        Ok(Self::build_all(primitives, options, progress, false)?.0)
    }

    /// Builds the tree, and beside it a box for each of its nodes: around the parts of primitives in
    /// all leaves below it, as clipped on the way down; empty where there are none. What stores
    /// tight boxes need not clip again.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub(crate) fn build_with_boxes(
        primitives: &impl Primitives<K>,
        options: &BuildOptions,
        progress: &(dyn Fn(BuildProgress) -> ControlFlow<()> + Sync),
    ) -> Result<(Self, Vec<Aabb<K>>), BuildError> {
        Self::build_all(primitives, options, progress, true)
    }

    /// Builds the tree and, if `keep_boxes` says so, the boxes of its nodes.
    fn build_all(
        primitives: &impl Primitives<K>,
        options: &BuildOptions,
        progress: &(dyn Fn(BuildProgress) -> ControlFlow<()> + Sync),
        keep_boxes: bool,
    ) -> Result<(Self, Vec<Aabb<K>>), BuildError> {
        const { assert!(K >= 1 && K <= 3, "a node has room for three axes") };
        let progress = &Progress::new(progress);
        let cost = options.cost;
        cost.check()?;
        options.check_memory(options.peak_bytes(primitives.count()))?;
        macro_rules! build {
            ($strategy:expr) => {
                Build { primitives, strategy: &$strategy, options, progress, keep_boxes }.run()
            };
        }
        match (options.strategy, options.sah_builder) {
            (Strategy::Middle, _) => build!(middle::Middle),
            (Strategy::Median, _) => build!(median::Median),
            (Strategy::RoundRobin, _) => build!(round_robin::RoundRobin),
            (Strategy::Sah, SahBuilder::Sweep) => build!(sah::Sweep { cost }),
            (Strategy::Sah, SahBuilder::Naive) => build!(sah::Naive { cost }),
            (Strategy::Sah, SahBuilder::Binned { sweep_below }) => {
                build!(sah::Binned { cost, sweep_below })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitives::TriangleMesh;
    use crate::tree::NodeKind;
    use rand::{RngExt, SeedableRng};

    fn soup() -> TriangleMesh {
        let mut random = rand_pcg::Pcg64::seed_from_u64(1);
        let triangles = (0..6000).map(|_| {
            let center = [0; 3].map(|_| random.random::<f32>());
            [0; 3].map(|_| center.map(|x| x + 0.2 * random.random::<f32>()))
        });
        TriangleMesh::from_soup(triangles).unwrap()
    }

    #[test]
    fn boxes_come_with_each_node() {
        let mesh = soup();
        for options in Preset::ALL.map(BuildOptions::preset) {
            let go_on = |_| ControlFlow::Continue(());
            let (tree, boxes) = KdTree::build_with_boxes(&mesh, &options, &go_on).unwrap();
            assert!(tree == KdTree::build(&mesh, &options).unwrap(), "{options:?}");
            assert_eq!(boxes.len(), tree.nodes().len());
            let near =
                |a: &[f32; 3], b: &[f32; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
            for cell in tree.cells() {
                let found = boxes[cell.node as usize];
                assert!(
                    found.is_empty() || found.union(&cell.bounds) == cell.bounds,
                    "in the cell"
                );
                let expected = match tree.nodes()[cell.node as usize].kind() {
                    NodeKind::Inner { above, .. } => {
                        boxes[cell.node as usize + 1].union(&boxes[above as usize])
                    }
                    NodeKind::Leaf { .. } => {
                        let parts = tree.leaf_primitives(cell.node).iter();
                        let parts = parts.filter_map(|&id| mesh.clipped_bounds(id, &cell.bounds));
                        parts.fold(Aabb::EMPTY, |all, part| all.union(&part))
                    }
                };
                // Looser than the true bounds by rounding at most.
                assert!(
                    found == expected
                        || near(&found.min, &expected.min) && near(&found.max, &expected.max)
                );
            }
        }
    }
}
