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
         split the mesh, place fewer copies, or raise the limit",
        gigabytes([*needed, *limit])[0],
        gigabytes([*needed, *limit])[1]
    )]
    Memory {
        /// How many bytes it is expected to take: [`BuildOptions::peak_bytes`], or once the canonical
        /// tree is there, what both trees take; of copies [`InstancedScene::peak_bytes`].
        ///
        /// [`BuildOptions::peak_bytes`]: super::BuildOptions::peak_bytes
        /// [`InstancedScene::peak_bytes`]: crate::InstancedScene::peak_bytes
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

/// As people say it: with as few decimals, from one on, as tell the two apart, and from nothing.
fn gigabytes(bytes: [u64; 2]) -> [String; 2] {
    const ALL: usize = 9;
    let text = |decimals: usize| bytes.map(|bytes| format!("{:.decimals$}", bytes as f64 / 1e9));
    let is_nothing = |text: &String| text.bytes().all(|digit| digit == b'0' || digit == b'.');
    let are_told = |texts: &[String; 2]| texts[0] != texts[1] && !texts.iter().any(is_nothing);
    (1..ALL).map(text).find(are_told).unwrap_or_else(|| text(ALL))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_sizes_are_told_apart() {
        let told = |needed, limit| gigabytes([needed, limit]);
        assert_eq!(told(12_340_000_000, 8_000_000_000), ["12.3", "8.0"]);
        assert_eq!(told(8_010_000_000, 8_000_000_000), ["8.01", "8.00"]);
        assert_eq!(told(2_000_000_000, 4_000_000), ["2.000", "0.004"]);
        assert_eq!(told(1_000_001, 1_000_000), ["0.001000001", "0.001000000"]);
    }
}
