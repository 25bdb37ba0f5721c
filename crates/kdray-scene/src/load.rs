//! From a file or a stream to a model.

use crate::formats::{Request, read_format};
use crate::input::{Limited, Siblings, decompressed, peek};
use crate::{Format, LoadError, Model};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// How files are loaded.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadOptions {
    /// The format; if none, the file's name tells it, or else its content.
    pub format: Option<Format>,
    /// How many bytes a file may have after decompression, and each file that it refers to; 8 GiB
    /// by default. All buffers of a glTF file together may have as many, those in the file and
    /// those beside it.
    pub max_bytes: u64,
    /// Drop triangles that use vertices that are not there or not finite, with a warning that
    /// counts them, instead of refusing the file.
    pub drop_bad: bool,
}

impl Default for LoadOptions {
    fn default() -> Self {
        Self { format: None, max_bytes: 8 << 30, drop_bad: false }
    }
}

/// Reads the file at `path`, and the files beside it that it refers to.
///
/// The format is the one in `options`, or the one that the name tells (`NAME.ply`,
/// `NAME.ply.zst`, `NAME.ply.gz`), or the one that the content looks like. Compressed files are
/// known by their content and decompressed while they are read.
///
/// # Errors
/// [`LoadError`] names the file, the place and the reason.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Model, LoadError> {
    let name = path.display().to_string();
    let fail = |error| LoadError::Io { file: name.clone(), error };
    if path.is_dir() {
        return Err(fail(io::ErrorKind::IsADirectory.into()));
    }
    let file = File::open(path).map_err(fail)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let format = options.format.or_else(|| Format::from_name(&name));
    read_from(Box::new(file), format, &name, Siblings::In(folder), options)
}

/// Reads a model in `format` from a stream, such as the standard input, which may be compressed.
/// `name` stands for the file in messages. Nothing beside the stream is read: a missing material
/// library or texture becomes a warning, a missing glTF buffer an error.
///
/// # Errors
/// [`LoadError`] names the stream, the place and the reason.
pub fn read(
    bytes: impl Read,
    format: Format,
    name: &str,
    options: &LoadOptions,
) -> Result<Model, LoadError> {
    read_from(Box::new(bytes), Some(format), name, Siblings::Nowhere, options)
}

fn read_from(
    bytes: Box<dyn Read + '_>,
    format: Option<Format>,
    name: &str,
    siblings: Siblings<'_>,
    options: &LoadOptions,
) -> Result<Model, LoadError> {
    let fail = |error| LoadError::Io { file: name.to_owned(), error };
    let plain = Limited::new(decompressed(bytes).map_err(fail)?, options.max_bytes);
    let request = Request { file: name, siblings, options };
    let peeked =
        peek(Box::new(plain), 1024).and_then(|(start, bytes)| unmarked(start, bytes, format));
    let (start, bytes) = peeked.map_err(|e| request.read_error(e))?;
    let format = format
        .or_else(|| Format::from_content(&start))
        .ok_or_else(|| LoadError::UnknownFormat { file: name.to_owned() })?;
    read_format(format, bytes, &start, &request)
}

/// Start and bytes without the byte order mark with which some editors begin a text in UTF-8. What
/// a binary STL begins with means nothing, and counts.
fn unmarked<'a>(
    mut start: Vec<u8>,
    mut bytes: Box<dyn Read + 'a>,
    format: Option<Format>,
) -> io::Result<(Vec<u8>, Box<dyn Read + 'a>)> {
    const MARK: &[u8] = b"\xef\xbb\xbf";
    let is_binary_stl = format == Some(Format::Stl) && start.contains(&0);
    if start.starts_with(MARK) && !is_binary_stl {
        start.drain(..MARK.len());
        bytes.read_exact(&mut [0; MARK.len()])?;
    }
    Ok((start, bytes))
}
