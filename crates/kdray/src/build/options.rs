//! What to build.

use super::{CostModel, Preset, Strategy};
use crate::tree::MAX_DEPTH;

/// How [`Strategy::Sah`] finds the plane of least cost. [`Sweep`](Self::Sweep) and
/// [`Naive`](Self::Naive) give the same tree bit for bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SahBuilder {
    /// All bounds of the primitives are candidates. Sorted once, then swept: O(N log N) (Wald &
    /// Havran 2006).
    #[default]
    Sweep,
    /// The same candidates; each is compared with every primitive: O(N²). What the sweep is tested
    /// with.
    Naive,
    /// Bounds are counted in bins (Popov et al. 2006, Hunt et al. 2006); only those around the best
    /// border between bins are candidates. Close to the sweep, and much faster.
    Binned {
        /// Nodes with no more primitives than this are swept.
        sweep_below: usize,
    },
}

/// What to build.
///
/// ```
/// use kdray::{BuildOptions, Strategy};
/// let options = BuildOptions { leaf_size: 4, ..BuildOptions::for_strategy(Strategy::Median) };
/// assert_eq!(options.depth_limit(1024), 21);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BuildOptions {
    /// How the splitting plane is chosen.
    pub strategy: Strategy,
    /// What the surface area heuristic weighs.
    pub cost: CostModel,
    /// How the surface area heuristic counts.
    pub sah_builder: SahBuilder,
    /// A node with no more primitives than this is not cut (step 2).
    pub leaf_size: usize,
    /// Whether a subtree becomes a leaf where that costs no more, when all below it is built. Costs
    /// are weighed by the boxes around what is listed in each node.
    pub prune: bool,
    /// No leaf is deeper than this (step 2); `None`: 8 + 1.3·log2 N. At most [`MAX_DEPTH`].
    pub max_depth: Option<usize>,
    /// A build that is expected to take more bytes than this, by [`peak_bytes`](Self::peak_bytes),
    /// is refused before it begins; `None`: none is. It changes nothing about the tree.
    pub memory_limit: Option<u64>,
}

impl Default for BuildOptions {
    /// Those of [`Preset::Balanced`].
    fn default() -> Self {
        Self::preset(Preset::default())
    }
}

impl BuildOptions {
    /// Entries that all leaves' lists may have together, per primitive and besides.
    ///
    /// Each node has a part of this quota; a split whose children would hold more than the node's
    /// part is refused, and the children share it in proportion to what they hold. Trees of real
    /// scenes stay far below it (SAH: 2 to 6 per primitive); it is there for primitives that no
    /// plane separates, which would otherwise double with every level.
    const QUOTA: (u64, u64) = (32, 1024);

    /// Good settings for a strategy. [`Strategy::Sah`] itself knows when to stop; the others need
    /// a leaf size that does not make them cut around every vertex down to the depth limit.
    pub fn for_strategy(strategy: Strategy) -> Self {
        let leaf_size = if strategy == Strategy::Sah { 1 } else { 8 };
        let sah_builder = SahBuilder::default();
        let (cost, prune, max_depth) = (CostModel::default(), false, None);
        Self { strategy, cost, sah_builder, leaf_size, prune, max_depth, memory_limit: None }
    }

    /// Good settings for a purpose.
    pub fn preset(preset: Preset) -> Self {
        preset.options()
    }

    /// The depth that no leaf of a tree over `count` primitives exceeds.
    pub fn depth_limit(&self, count: usize) -> usize {
        let log2 = (count.max(1) as f64).log2();
        self.max_depth.unwrap_or((8.0 + 1.3 * log2) as usize).min(MAX_DEPTH)
    }

    /// How many entries the leaves of a tree over `count` primitives have together at most:
    /// 32 a primitive and 1024 besides, but fewer than 2^30.
    pub fn reference_quota(count: usize) -> u64 {
        let (per_primitive, besides) = Self::QUOTA;
        let quota = (count as u64).saturating_mul(per_primitive).saturating_add(besides);
        quota.min(u64::from(crate::tree::Node::MAX_INDEX))
    }
}
