//! What can be wrong with a file.

use crate::layout::WideError;
use crate::primitives::MeshError;
use crate::tree::TreeError;
use thiserror::Error;

/// Why bytes are not a tree file that can be used.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FileError {
    /// The bytes do not begin as a tree file does.
    #[error("this is no tree file of kdray")]
    NotATreeFile,
    /// The format is of another version.
    #[error("the tree file is of version {0}, but version 1 is what can be read; save it anew")]
    Version(u32),
    /// The coordinates are not of the scene's precision.
    #[error(
        "the tree file has coordinates of {found} bits, where {expected} are expected; open it as a Scene<f{found}>, or save one of f{expected}"
    )]
    Precision {
        /// The bits of those in the file.
        found: u32,
        /// Those of the scene that was asked for.
        expected: u32,
    },
    /// The header is not what was written.
    #[error("the header of the tree file is damaged; save it anew")]
    DamagedHeader,
    /// The header was never written by kdray.
    #[error("the header of the tree file contradicts itself: {0}")]
    BadHeader(&'static str),
    /// There are fewer or more bytes than the header says.
    #[error("the tree file has {found} bytes where {expected} are expected; save it anew")]
    Length {
        /// What the header says.
        expected: u64,
        /// How many there are.
        found: u64,
    },
    /// The bytes behind the header are not what was written.
    #[error("the tree file is damaged: its checksum is wrong; save it anew")]
    Damaged,
    /// The mesh is not one that could be built over.
    #[error("the tree file is no honest one: {0}")]
    Mesh(#[from] MeshError),
    /// The canonical tree is broken.
    #[error("the tree file is no honest one: {0}")]
    Tree(#[from] TreeError),
    /// The wide tree is broken, or is not that of the canonical one.
    #[error("the tree file is no honest one: {0}")]
    Wide(#[from] WideError),
}
