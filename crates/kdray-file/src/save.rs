//! Writing.

use crate::{Output, TreeFileError};
use kdray::{Precision, Scene};
use std::io::{self, Write};
use std::path::Path;

/// Writes a scene to a file, as an [`Output`]: whoever has mapped or is reading an older file at `path` keeps that one,
/// and a file at `path` is whole.
///
/// # Errors
/// [`TreeFileError::Io`].
pub fn save<T: Precision>(scene: &Scene<T>, path: &Path) -> Result<(), TreeFileError> {
    write(scene, path).map_err(|source| TreeFileError::io(path, source))
}

fn write<T: Precision>(scene: &Scene<T>, path: &Path) -> io::Result<()> {
    let mut output = Output::create(path)?;
    scene.save(|bytes| output.file().write_all(bytes))?;
    output.commit()
}
