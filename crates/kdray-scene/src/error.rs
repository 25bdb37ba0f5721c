//! Why a file could not be loaded.

use std::fmt;
use std::io;
use thiserror::Error;

/// Why a file could not be loaded. Each names the file, and as far as it can the place and what
/// to do. What the system said is part of the message, and not also its source.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LoadError {
    /// The file, or one that it refers to, could not be opened or read.
    #[error("{file}: cannot be read: {error}")]
    Io {
        /// The file.
        file: String,
        /// What the system or the decompression says.
        error: io::Error,
    },
    /// Neither the name nor the content tells the format.
    #[error(
        "{file}: neither its name nor its content tells the format; name the format, or give the \
         file one of the endings .obj .ply .stl .off .gltf .glb, with .gz or .zst if compressed"
    )]
    UnknownFormat {
        /// The file.
        file: String,
    },
    /// The decompressed input goes on beyond [`LoadOptions::max_bytes`](crate::LoadOptions).
    #[error("{file}: longer than the limit of {limit} bytes when decompressed; raise the limit")]
    TooLong {
        /// The file.
        file: String,
        /// The limit in bytes.
        limit: u64,
    },
    /// The content breaks the rules of the format.
    #[error("{file}: {place}: {reason}")]
    Invalid {
        /// The file.
        file: String,
        /// Where in the file.
        place: Place,
        /// What is wrong there.
        reason: String,
    },
    /// The file needs something that is not read.
    #[error("{file}: {place}: {what} is not supported; export the file without it")]
    Unsupported {
        /// The file.
        file: String,
        /// Where in the file.
        place: Place,
        /// What it needs.
        what: String,
    },
    /// A file that the content is incomplete without is missing.
    #[error("{file}: {place}: refers to {missing:?}, which cannot be read: {error}")]
    Missing {
        /// The file.
        file: String,
        /// Where in the file.
        place: Place,
        /// What it refers to.
        missing: String,
        /// Why that cannot be read.
        error: io::Error,
    },
}

impl LoadError {
    /// The error of one file with one place and reason.
    pub(crate) fn invalid(file: &str, place: Place, reason: impl Into<String>) -> Self {
        Self::Invalid { file: file.to_owned(), place, reason: reason.into() }
    }
}

/// Where in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// In this line, counted from 1.
    Line(u64),
    /// At this byte of the decompressed file, counted from 0.
    Byte(u64),
    /// In one of a list of like things, such as the faces of a PLY file, counted from 0.
    Element {
        /// What they are called in the file.
        name: String,
        /// Which of them.
        index: u64,
    },
    /// At this path in a JSON document, such as `meshes[0].primitives[1]`.
    Json(String),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
            Self::Element { name, index } => write!(f, "{name} {index}"),
            Self::Json(path) => f.write_str(path),
        }
    }
}
