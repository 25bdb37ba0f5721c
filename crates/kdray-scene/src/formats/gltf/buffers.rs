//! Buffers and images: where their bytes are.

use super::Document;
use crate::{LoadError, Place};
use ::gltf::json::Index;
use ::gltf::json::buffer::View;
use data_url::DataUrl;
use percent_encoding::percent_decode_str;
use std::io;

/// The bytes of all buffers.
pub(super) struct Buffers {
    buffers: Vec<Vec<u8>>,
}

impl Buffers {
    pub(super) fn load(
        document: Document<'_>,
        mut binary: Option<Vec<u8>>,
    ) -> Result<Self, LoadError> {
        let mut buffers = Vec::new();
        for (index, buffer) in document.root.buffers.iter().enumerate() {
            let path = format!("buffers[{index}]");
            let bytes = match &buffer.uri {
                Some(uri) => read_uri(document, uri).map_err(|source| LoadError::Missing {
                    file: document.request.file.to_owned(),
                    place: Place::Json(path.clone()),
                    missing: uri.chars().take(100).collect(),
                    source,
                })?,
                None if index == 0 => binary.take().unwrap_or_default(),
                None => Vec::new(),
            };
            if (bytes.len() as u64) < buffer.byte_length.0 {
                let (stated, got) = (buffer.byte_length.0, bytes.len());
                let reason = format!("says it has {stated} bytes, but there are {got}");
                return Err(document.invalid(&path, reason));
            }
            buffers.push(bytes);
        }
        Ok(Self { buffers })
    }

    /// How many bytes all buffers have.
    pub(super) fn total(&self) -> usize {
        self.buffers.iter().map(Vec::len).sum()
    }

    /// The bytes of a view.
    pub(super) fn view(
        &self,
        document: Document<'_>,
        index: Index<View>,
    ) -> Result<&[u8], LoadError> {
        let path = format!("bufferViews[{}]", index.value());
        let view = document.root.get(index).ok_or_else(|| document.invalid(&path, "missing"))?;
        let buffer = self.buffers.get(view.buffer.value()).map_or(&[][..], Vec::as_slice);
        let start = usize::try_from(view.byte_offset.unwrap_or_default().0).ok();
        let length = usize::try_from(view.byte_length.0).ok();
        let range = start.zip(length).and_then(|(s, l)| Some(s..s.checked_add(l)?));
        range
            .and_then(|range| buffer.get(range))
            .ok_or_else(|| document.invalid(&path, "reaches beyond its buffer"))
    }
}

/// The bytes that a URI stands for: in itself, or in a file beside the document.
pub(super) fn read_uri(document: Document<'_>, uri: &str) -> io::Result<Vec<u8>> {
    let invalid = |reason: &str| io::Error::new(io::ErrorKind::InvalidInput, reason);
    if uri.get(..5).is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:")) {
        let url = DataUrl::process(uri).map_err(|_| invalid("not a data URI"))?;
        return Ok(url.decode_to_vec().map_err(|_| invalid("not base64"))?.0);
    }
    if uri.contains("://") {
        return Err(invalid("files on other machines are not fetched"));
    }
    let request = document.request;
    let decoded = percent_decode_str(uri).decode_utf8_lossy();
    let limit = request.options.max_bytes;
    // Some programs do not encode names, so that `%20` can also stand for itself.
    request.siblings.read(&decoded, limit).or_else(|error| {
        if decoded == uri { Err(error) } else { request.siblings.read(uri, limit).or(Err(error)) }
    })
}
