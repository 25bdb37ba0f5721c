//! The readers, one a format.

mod gltf;
mod obj;
mod off;
mod ply;
mod stl;

use crate::input::Siblings;
use crate::{Format, LoadError, LoadOptions, Model, Place};
use std::io::{self, ErrorKind, Read};

/// What a reader is asked to read.
pub(crate) struct Request<'a> {
    /// The file's name for messages.
    pub(crate) file: &'a str,
    /// The files beside it.
    pub(crate) siblings: Siblings<'a>,
    pub(crate) options: &'a LoadOptions,
}

impl Request<'_> {
    /// An error at a place of the file.
    pub(crate) fn invalid(&self, place: Place, reason: impl Into<String>) -> LoadError {
        LoadError::invalid(self.file, place, reason)
    }

    /// The error that a failed read of the file is.
    pub(crate) fn read_error(&self, error: io::Error) -> LoadError {
        let file = self.file.to_owned();
        match error.kind() {
            ErrorKind::FileTooLarge => LoadError::TooLong { file, limit: self.options.max_bytes },
            _ => LoadError::Io { file, error },
        }
    }
}

/// Reads `bytes`, which begin with `start`, in the given format.
pub(crate) fn read_format(
    format: Format,
    bytes: Box<dyn Read + '_>,
    start: &[u8],
    request: &Request<'_>,
) -> Result<Model, LoadError> {
    match format {
        Format::Obj => obj::read(bytes, start, request),
        Format::Ply => ply::read(bytes, request),
        Format::Stl => stl::read(bytes, start, request),
        Format::Off => off::read(bytes, request),
        Format::Gltf => gltf::read(bytes, start, request),
    }
}
