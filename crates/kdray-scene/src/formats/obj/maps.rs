//! The textures of materials.

use super::Request;
use super::mtl::Map;
use crate::cut::cut;
use crate::input::read_file;
use crate::mesh::MeshBuilder;
use crate::textures::{Encoding, TextureDecoder};
use crate::{TextureRef, Wrap};
use std::collections::HashMap;
use std::io::{self, ErrorKind};
use std::path::PathBuf;

/// Textures by their files and what lies beyond their edges: each file is read once for either,
/// clamped or repeated. None for one that failed.
pub(super) struct Maps<'a> {
    textures: TextureDecoder,
    /// By the path, or by the name of a file that is not there, and whether the map clamps.
    known: HashMap<(PathBuf, bool), Option<usize>>,
    request: &'a Request<'a>,
}

impl<'a> Maps<'a> {
    pub(super) fn new(request: &'a Request<'a>) -> Self {
        Self { textures: TextureDecoder::default(), known: HashMap::new(), request }
    }

    pub(super) fn texture(
        &mut self,
        map: &Map,
        builder: &mut MeshBuilder<'_>,
    ) -> Option<TextureRef> {
        let found = self.request.siblings.find(&map.file);
        let key = (found.as_ref().map_or(map.file.as_str().into(), PathBuf::clone), map.clamp);
        let index = match self.known.get(&key) {
            Some(known) => *known,
            None => {
                let index = self.load(map, found, builder);
                self.known.insert(key, index);
                index
            }
        };
        // The libraries' v points up: with v' = 1 − v, s·v + o becomes s·v' + 1 − s − o.
        let ([su, sv], [ou, ov]) = (map.scale, map.offset);
        let transform = [[su, 0.0, ou], [0.0, sv, 1.0 - sv - ov]];
        index.map(|texture| TextureRef { texture, transform })
    }

    fn load(
        &mut self,
        map: &Map,
        found: io::Result<PathBuf>,
        builder: &mut MeshBuilder<'_>,
    ) -> Option<usize> {
        let wrap = if map.clamp { [Wrap::Clamp; 2] } else { [Wrap::Repeat; 2] };
        let limit = self.request.options.max_bytes;
        let texture = found
            .and_then(|path| read_file(&path, limit))
            .map_err(|error| match error.kind() {
                ErrorKind::FileTooLarge => "longer than the limit".to_owned(),
                _ => error.to_string(),
            })
            .and_then(|bytes| self.textures.decode(&bytes, Encoding::Srgb, wrap));
        match texture {
            Ok(texture) => {
                builder.model.textures.push(texture);
                Some(builder.model.textures.len() - 1)
            }
            Err(reason) => {
                let warning = format!("texture {:?} left out: {reason}", cut(&map.file));
                builder.warn_often("textures left out", warning);
                None
            }
        }
    }
}
