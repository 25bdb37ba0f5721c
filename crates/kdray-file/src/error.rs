//! What can go wrong with a tree file.

use kdray::FileError;
use std::io;
use std::path::{Path, PathBuf};

/// Why a tree file was not written or cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TreeFileError {
    /// The system did not let the file be read or written.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file is not one that can be used.
    #[error("{}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: FileError,
    },
    /// To read the file and to verify it would take more memory than is allowed.
    #[error(
        "{}: to load it takes {needed} bytes of memory, but {limit} are allowed; map it instead, or allow more",
        path.display()
    )]
    Memory {
        /// The file.
        path: PathBuf,
        /// How much it takes.
        needed: u64,
        /// How much is allowed.
        limit: u64,
    },
}

impl TreeFileError {
    pub(crate) fn io(path: &Path, source: io::Error) -> Self {
        Self::Io { path: path.to_owned(), source }
    }

    pub(crate) fn file(path: &Path, source: FileError) -> Self {
        Self::File { path: path.to_owned(), source }
    }
}
