//! The JSON, alone or in a GLB container.

use super::{Document, Request};
use crate::{LoadError, Place};
use ::gltf::json::validation::{Error, Validate};
use ::gltf::json::{Path, Root};
use std::io::{BufReader, Read};

pub(super) struct Container {
    pub(super) root: Root,
    /// The BIN chunk of a GLB.
    pub(super) binary: Option<Vec<u8>>,
}

pub(super) fn read(
    bytes: Box<dyn Read + '_>,
    start: &[u8],
    request: &Request<'_>,
) -> Result<Container, LoadError> {
    if start.starts_with(b"glTF") {
        return read_glb(bytes, request);
    }
    if !start.trim_ascii_start().starts_with(b"{") {
        let reason = "neither a JSON object nor a GLB container";
        return Err(request.invalid(Place::Byte(0), reason));
    }
    let root = parse(serde_json::Deserializer::from_reader(BufReader::new(bytes)), request)?;
    Ok(Container { root, binary: None })
}

/// A header of 12 bytes, a JSON chunk, perhaps a BIN chunk, and chunks to pass over.
fn read_glb(mut bytes: Box<dyn Read + '_>, request: &Request<'_>) -> Result<Container, LoadError> {
    let mut at = 0;
    let [_, version, _] = words(&mut bytes, &mut at, request)?;
    if version != 2 {
        return Err(unsupported(request, Place::Byte(4), format!("version {version} of GLB")));
    }
    let [length, kind] = words(&mut bytes, &mut at, request)?;
    if kind != u32::from_le_bytes(*b"JSON") {
        return Err(request.invalid(Place::Byte(16), "the first chunk is not JSON"));
    }
    let json = chunk(&mut bytes, &mut at, length, request)?;
    let root = parse(serde_json::Deserializer::from_slice(&json), request)?;
    let mut binary = None;
    // Without a BIN chunk the file ends here.
    if let Ok([length, kind]) = words(&mut bytes, &mut at, request)
        && kind == u32::from_le_bytes(*b"BIN\0")
    {
        binary = Some(chunk(&mut bytes, &mut at, length, request)?);
    }
    Ok(Container { root, binary })
}

fn words<const N: usize>(
    bytes: &mut dyn Read,
    at: &mut u64,
    request: &Request<'_>,
) -> Result<[u32; N], LoadError> {
    let mut words = [0; N];
    for word in &mut words {
        let mut raw = [0; 4];
        bytes.read_exact(&mut raw).map_err(|error| match error.kind() {
            std::io::ErrorKind::UnexpectedEof => truncated(request, *at),
            _ => request.read_error(error),
        })?;
        *word = u32::from_le_bytes(raw);
        *at += 4;
    }
    Ok(words)
}

/// The content of a chunk. It grows as bytes come, so that a false length takes no memory.
fn chunk(
    bytes: &mut dyn Read,
    at: &mut u64,
    length: u32,
    request: &Request<'_>,
) -> Result<Vec<u8>, LoadError> {
    let mut content = Vec::new();
    let got = bytes.take(u64::from(length)).read_to_end(&mut content);
    *at += got.map_err(|error| request.read_error(error))? as u64;
    if content.len() as u64 != u64::from(length) {
        return Err(truncated(request, *at));
    }
    Ok(content)
}

fn truncated(request: &Request<'_>, at: u64) -> LoadError {
    request.invalid(Place::Byte(at), "the file ends too early")
}

fn unsupported(request: &Request<'_>, place: Place, what: String) -> LoadError {
    LoadError::Unsupported { file: request.file.to_owned(), place, what }
}

/// The document, with the path to what is wrong with it.
fn parse<'a, R: serde_json::de::Read<'a>>(
    mut json: serde_json::Deserializer<R>,
    request: &Request<'_>,
) -> Result<Root, LoadError> {
    let root = serde_path_to_error::deserialize(&mut json).map_err(|error| {
        let path = error.path().to_string();
        json_error(error.into_inner(), &path, request)
    })?;
    json.end().map_err(|error| json_error(error, "after the end", request))?;
    Ok(root)
}

fn json_error(error: serde_json::Error, path: &str, request: &Request<'_>) -> LoadError {
    if error.is_io() {
        return request.read_error(error.into());
    }
    request.invalid(Place::Json(format!("JSON at {path}")), error.to_string())
}

/// Checks versions, and by the rules of the `gltf` crate indices and enumerations. What is merely
/// missing is left to those who need it.
pub(super) fn validate(document: Document<'_>) -> Result<(), LoadError> {
    let Document { root, request } = document;
    if !root.asset.version.starts_with("2.") {
        let place = Place::Json("asset.version".to_owned());
        return Err(unsupported(request, place, format!("glTF {}", root.asset.version)));
    }
    // The crate's own check looks positions up without asking whether they are there.
    for (mesh, primitives) in root.meshes.iter().map(|mesh| &mesh.primitives).enumerate() {
        for (number, primitive) in primitives.iter().enumerate() {
            let mut accessors = primitive.attributes.values();
            if accessors.any(|accessor| root.get(*accessor).is_none()) {
                let path = format!("meshes[{mesh}].primitives[{number}].attributes");
                return Err(document.invalid(&path, "index out of bounds"));
            }
        }
    }
    let mut first = None;
    root.validate(root, Path::new, &mut |path, error| {
        if matches!(error, Error::IndexOutOfBounds | Error::Invalid | Error::Oversize) {
            first.get_or_insert_with(|| (path().to_string(), error));
        }
    });
    match first {
        Some((path, error)) => Err(document.invalid(&path, error.to_string().to_lowercase())),
        None => Ok(()),
    }
}
