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
    /// More memory would be needed than the options allow.
    #[error(
        "the build needs about {} GB of memory, but {} GB is the limit; take the preset fast, \
         split the mesh, or raise the limit",
        gigabytes(*needed),
        gigabytes(*limit)
    )]
    Memory {
        /// How many bytes it is expected to take: [`BuildOptions::peak_bytes`], or once the canonical
        /// tree is there, what both trees take.
        ///
        /// [`BuildOptions::peak_bytes`]: super::BuildOptions::peak_bytes
        needed: u64,
        /// [`BuildOptions::memory_limit`].
        ///
        /// [`BuildOptions::memory_limit`]: super::BuildOptions::memory_limit
        limit: u64,
    },
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

/// As people say it, in steps that tell any two apart that matter.
fn gigabytes(bytes: u64) -> String {
    let whole = bytes as f64 / 1e9;
    if whole < 0.095 { format!("{whole:.4}") } else { format!("{whole:.1}") }
}
