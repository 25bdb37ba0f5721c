//! Buffers and the views of them.

use super::Document;
use super::content::Content;
use crate::{LoadError, Place};
use ::gltf::json::Index;
use ::gltf::json::buffer::View;
use std::collections::HashMap;
use std::io::ErrorKind;
use std::path::PathBuf;
use std::rc::Rc;

/// The bytes of all buffers. Buffers of one file share them.
pub(super) struct Buffers {
    buffers: Vec<Rc<Vec<u8>>>,
    total: u64,
}

impl Buffers {
    pub(super) fn load(document: Document<'_>, binary: Option<Vec<u8>>) -> Result<Self, LoadError> {
        let mut loader = Loader::new(document, binary.unwrap_or_default());
        let mut buffers = Vec::new();
        for (index, buffer) in document.root.buffers.iter().enumerate() {
            let path = format!("buffers[{index}]");
            let bytes = match &buffer.uri {
                Some(uri) => loader.bytes(uri, &path)?,
                None if index == 0 => Rc::clone(&loader.binary),
                None => Rc::default(),
            };
            if (bytes.len() as u64) < buffer.byte_length.0 {
                let (stated, got) = (buffer.byte_length.0, bytes.len());
                let reason = format!("says it has {stated} bytes, but there are {got}");
                return Err(document.invalid(&path, reason));
            }
            buffers.push(bytes);
        }
        Ok(Self { buffers, total: loader.total })
    }

    /// How many bytes all buffers have, those that they share counted once.
    pub(super) fn total(&self) -> u64 {
        self.total
    }

    /// The bytes of a view.
    pub(super) fn view(
        &self,
        document: Document<'_>,
        index: Index<View>,
    ) -> Result<&[u8], LoadError> {
        let path = format!("bufferViews[{}]", index.value());
        let view = document.root.get(index).ok_or_else(|| document.invalid(&path, "missing"))?;
        let buffer = self.buffers.get(view.buffer.value()).map_or(&[][..], |bytes| bytes);
        let start = usize::try_from(view.byte_offset.unwrap_or_default().0).ok();
        let length = usize::try_from(view.byte_length.0).ok();
        let range = start.zip(length).and_then(|(s, l)| Some(s..s.checked_add(l)?));
        range
            .and_then(|range| buffer.get(range))
            .ok_or_else(|| document.invalid(&path, "reaches beyond its buffer"))
    }
}

/// Reads what buffers point at, each file once, and all together within the limit of a file.
struct Loader<'a> {
    document: Document<'a>,
    /// The BIN chunk of a GLB.
    binary: Rc<Vec<u8>>,
    known: HashMap<PathBuf, Rc<Vec<u8>>>,
    total: u64,
}

impl<'a> Loader<'a> {
    fn new(document: Document<'a>, binary: Vec<u8>) -> Self {
        let total = binary.len() as u64;
        Self { document, binary: Rc::new(binary), known: HashMap::new(), total }
    }

    fn bytes(&mut self, uri: &str, path: &str) -> Result<Rc<Vec<u8>>, LoadError> {
        let request = self.document.request;
        let missing = |error| LoadError::Missing {
            file: request.file.to_owned(),
            place: Place::Json(path.to_owned()),
            missing: uri.chars().take(100).collect(),
            error,
        };
        let content = Content::find(self.document, uri).map_err(missing)?;
        if let Content::File(path) = &content
            && let Some(known) = self.known.get(path)
        {
            return Ok(Rc::clone(known));
        }
        let limit = request.options.max_bytes;
        let bytes = content.read(limit.saturating_sub(self.total)).map_err(|error| {
            if error.kind() == ErrorKind::FileTooLarge {
                let reason = format!("all buffers have more than {limit} bytes; raise the limit");
                return self.document.invalid(path, reason);
            }
            missing(error)
        })?;
        self.total += bytes.len() as u64;
        let bytes = Rc::new(bytes);
        if let Content::File(path) = content {
            self.known.insert(path, Rc::clone(&bytes));
        }
        Ok(bytes)
    }
}
