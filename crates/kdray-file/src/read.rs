//! Reading and mapping.

use crate::TreeFileError;
use kdray::file::{self, AnyScene, HEADER_BYTES};
use kdray::memory::{AlignedBytes, SharedBytes};
use kdray::{FileError, Precision, Scene};
use kdray_map::Map;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use std::sync::Arc;

/// To load a file takes so many times its length at most: for its content, and for what verifying it takes
/// meanwhile, above all 32 bytes a leaf, of which a file has 16 and more.
const MEMORY: u64 = 3;

/// Whether a file begins as a tree file does.
///
/// # Errors
/// What the system says.
pub fn is_tree_file(path: &Path) -> io::Result<bool> {
    // What is no file may block when it is opened, or give each byte only once.
    if !std::fs::metadata(path)?.is_file() {
        return Ok(false);
    }
    read_header(&File::open(path)?).map(|header| file::is_tree_file(&header))
}

/// Reads a file into memory and verifies all of it: what answers queries then is right, whoever made the
/// file, and does not change with it. Its coordinates must be of the scene's precision; [`load_any`] takes
/// either.
///
/// Takes about as long as a build, and three times the length of the file in memory at most; if that is more than
/// `memory_limit`, if any, the file is refused before it is read.
///
/// # Errors
/// See [`TreeFileError`].
pub fn load<T: Precision>(
    path: &Path,
    memory_limit: Option<u64>,
) -> Result<Scene<T>, TreeFileError> {
    let bytes = read(path, memory_limit, file::check_precision::<T>)?;
    Scene::load(bytes).map_err(|source| TreeFileError::file(path, source))
}

/// [`load`] of a file of either precision.
///
/// # Errors
/// See [`TreeFileError`].
pub fn load_any(path: &Path, memory_limit: Option<u64>) -> Result<AnyScene, TreeFileError> {
    let bytes = read(path, memory_limit, |_| Ok(()))?;
    AnyScene::load(bytes).map_err(|source| TreeFileError::file(path, source))
}

/// Maps a file that you trust into memory: nothing is copied, and its memory is shared with all others who
/// map it. Its coordinates must be of the scene's precision; [`map_any`] takes either.
///
/// What is checked is header and structure ([`kdray::file`]), so that no query panics or hangs.
/// [`Scene::verify`] makes sure of the rest.
///
/// The file must not be written to for as long as the scene or a clone of it is there, or answers may be
/// anything, and the program may be ended ([`Map`] says how). To put a new one in its place, as
/// [`save`](crate::save()) does, is safe.
///
/// # Errors
/// See [`TreeFileError`].
pub fn map<T: Precision>(path: &Path) -> Result<Scene<T>, TreeFileError> {
    Scene::open(mapped(path)?).map_err(|source| TreeFileError::file(path, source))
}

/// [`map`] of a file of either precision.
///
/// # Errors
/// See [`TreeFileError`].
pub fn map_any(path: &Path) -> Result<AnyScene, TreeFileError> {
    AnyScene::open(mapped(path)?).map_err(|source| TreeFileError::file(path, source))
}

/// The bytes of a file whose header passes the check, in memory.
fn read(
    path: &Path,
    memory_limit: Option<u64>,
    check: impl Fn(&[u8]) -> Result<(), FileError>,
) -> Result<SharedBytes, TreeFileError> {
    let io = |source| TreeFileError::io(path, source);
    let refused = |source| TreeFileError::file(path, source);
    let file = open(path).map_err(io)?;
    let header = read_header(&file).map_err(io)?;
    let expected = file::file_bytes(&header).map_err(refused)?;
    check(&header).map_err(refused)?;
    let found = file.metadata().map_err(io)?.len();
    if found != expected {
        return Err(refused(FileError::Length { expected, found }));
    }
    let needed = expected.saturating_mul(MEMORY);
    if let Some(limit) = memory_limit.filter(|&limit| needed > limit) {
        return Err(TreeFileError::Memory { path: path.to_owned(), needed, limit });
    }
    let room = usize::try_from(expected).ok().and_then(AlignedBytes::zeroed);
    let mut bytes = room.ok_or_else(|| io(io::ErrorKind::OutOfMemory.into()))?;
    let (start, rest) = bytes.as_mut_slice().split_at_mut(HEADER_BYTES);
    start.copy_from_slice(&header);
    (&file).read_exact(rest).map_err(io)?;
    Ok(Arc::new(bytes))
}

/// The bytes of a file that begins with a header, mapped.
fn mapped(path: &Path) -> Result<SharedBytes, TreeFileError> {
    let io = |source| TreeFileError::io(path, source);
    let file = open(path).map_err(io)?;
    // Beforehand, for what is empty or short cannot be mapped everywhere.
    let header = read_header(&file).map_err(io)?;
    file::file_bytes(&header).map_err(|source| TreeFileError::file(path, source))?;
    Ok(Arc::new(Map::new(&file).map_err(io)?))
}

/// Opens what must be a file, not a pipe or a folder.
fn open(path: &Path) -> io::Result<File> {
    let found = std::fs::metadata(path)?;
    if found.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    if !found.is_file() {
        let reason = "a tree is read from a file, not from a device or a pipe";
        return Err(io::Error::new(io::ErrorKind::InvalidInput, reason));
    }
    File::open(path)
}

/// The first bytes, or as many as there are.
fn read_header(file: &File) -> io::Result<Vec<u8>> {
    let mut header = Vec::with_capacity(HEADER_BYTES);
    file.take(HEADER_BYTES as u64).read_to_end(&mut header)?;
    Ok(header)
}
