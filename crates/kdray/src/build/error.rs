//! Why there is no tree.

use crate::tree::CostModelError;
use thiserror::Error;

/// Why a tree could not be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum BuildError {
    /// The progress callback asked to stop.
    #[error("the build was cancelled")]
    Cancelled,
    /// The cost model is out of range.
    #[error(transparent)]
    CostModel(#[from] CostModelError),
    /// A primitive's box has a NaN or infinite bound.
    #[error("the bounds of primitive {0} are not finite; mend or drop it")]
    NonFiniteBounds(u32),
    /// More primitives than the tree's indices can name.
    #[error("{0} primitives do not fit one tree, which holds 1073741823 at most; split them")]
    TooManyPrimitives(usize),
    /// More nodes than the tree's indices can name.
    #[error(
        "the tree would have more than 1073741823 nodes; raise the leaf size or lower the depth \
         limit"
    )]
    TooManyNodes,
}
