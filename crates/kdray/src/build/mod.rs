//! From primitives to a tree: the six steps of the founding lecture (S6).

use crate::{
    Aabb,
    primitives::Primitives,
    tree::{KdTree, Node},
};
use std::ops::ControlFlow;
use thiserror::Error;

/// How the splitting plane is chosen (S7 to S10).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Strategy {
    /// The middle of the box's longest side.
    Middle,
    /// The median of the primitives' centroids on the longest side: as many left as right.
    Median,
    /// The axes in turn, X → Y → Z → X, each cut in the middle of the box.
    RoundRobin,
    /// The plane of least cost by the surface area heuristic.
    #[default]
    Sah,
}

/// What the surface area heuristic weighs: the cost of a split is
/// `traversal + intersection · (S_L·N_L + S_R·N_R) / S`, times `1 − empty_bonus` if a child is empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CostModel {
    /// The cost of visiting an inner node.
    pub traversal: f64,
    /// The cost of testing a primitive.
    pub intersection: f64,
    /// How much cheaper, from 0 to 1, a split counts that cuts off empty space.
    pub empty_bonus: f64,
}

/// What to build.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BuildOptions {
    /// How the splitting plane is chosen.
    pub strategy: Strategy,
    /// What the surface area heuristic weighs.
    pub cost: CostModel,
    /// A node with no more primitives than this is not cut (step 2).
    pub leaf_size: usize,
    /// No leaf is deeper than this (step 2); `None`: 8 + 1.3·log2 N.
    pub max_depth: Option<usize>,
}

/// How far a build is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BuildProgress {
    /// The part that is done, from 0 to 1, never falling.
    pub fraction: f64,
}

/// Why a tree could not be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum BuildError {
    /// The progress callback asked to stop.
    #[error("the build was cancelled")]
    Cancelled,
    /// A primitive's box has a NaN or infinite bound.
    #[error("the bounds of primitive {0} are not finite; mend or drop it")]
    NonFiniteBounds(u32),
    /// More primitives than the tree's indices can name.
    #[error("{0} primitives do not fit one tree, which holds 1073741823 at most; split them")]
    TooManyPrimitives(usize),
}

impl Default for CostModel {
    fn default() -> Self {
        Self { traversal: 1.0, intersection: 1.5, empty_bonus: 0.2 }
    }
}

impl Default for BuildOptions {
    fn default() -> Self {
        Self { strategy: Strategy::Sah, cost: CostModel::default(), leaf_size: 1, max_depth: None }
    }
}

impl<const K: usize> KdTree<K> {
    /// Builds the tree.
    pub fn build(
        primitives: &impl Primitives<K>,
        options: &BuildOptions,
    ) -> Result<Self, BuildError> {
        Self::build_with_progress(primitives, options, &|_| ControlFlow::Continue(()))
    }

    /// Builds the tree, and tells `progress` now and then how far it is, from any thread;
    /// [`ControlFlow::Break`] stops the build.
    pub fn build_with_progress(
        primitives: &impl Primitives<K>,
        options: &BuildOptions,
        progress: &(dyn Fn(BuildProgress) -> ControlFlow<()> + Sync),
    ) -> Result<Self, BuildError> {
        let _ = (options, progress);
        let ids = 0..primitives.count() as u32;
        let bounds = ids.clone().fold(Aabb::EMPTY, |b, id| b.union(&primitives.bounds(id)));
        Ok(Self { bounds, nodes: vec![Node::leaf(0, ids.end)], references: ids.collect() })
    }
}
