//! Textures, and the images that they share.

use super::Document;
use super::buffers::Buffers;
use super::content::Content;
use crate::cut::cut;
use crate::input::read_file;
use crate::mesh::MeshBuilder;
use crate::textures::{Encoding, TextureDecoder};
use crate::{Texture, Wrap};
use ::gltf::json::buffer::View;
use ::gltf::json::texture::WrappingMode;
use ::gltf::json::validation::Checked;
use ::gltf::json::{Image, Index};
use std::collections::HashMap;
use std::path::PathBuf;

/// Where the file of an image is; equal for all images of one file.
#[derive(PartialEq, Eq, Hash)]
enum ImageFile {
    View(Index<View>),
    File(PathBuf),
    /// In the URI of this image.
    Data(Index<Image>),
}

/// Decodes each image file once for each use of its numbers and what lies beyond its edge.
pub(super) struct Textures<'a> {
    document: Document<'a>,
    buffers: &'a Buffers,
    decoder: TextureDecoder,
    /// By the texture in the file: its index in the model, none for one that was left out.
    known: HashMap<(usize, Encoding), Option<usize>>,
    /// What textures share: the index in the model, or why there is none.
    decoded: HashMap<(ImageFile, Encoding, [Wrap; 2]), Result<usize, String>>,
}

impl<'a> Textures<'a> {
    pub(super) fn new(document: Document<'a>, buffers: &'a Buffers) -> Self {
        let (known, decoded) = (HashMap::new(), HashMap::new());
        Self { document, buffers, decoder: TextureDecoder::default(), known, decoded }
    }

    /// The index of a texture in the model; none, with a warning, if it cannot be read.
    pub(super) fn index(
        &mut self,
        texture: usize,
        encoding: Encoding,
        builder: &mut MeshBuilder<'_>,
    ) -> Option<usize> {
        if let Some(&known) = self.known.get(&(texture, encoding)) {
            return known;
        }
        let loaded = self.load(texture, encoding, builder);
        if let Err(reason) = &loaded {
            let warning = format!("textures[{texture}] left out: {reason}");
            builder.warn_often("textures left out", warning);
        }
        let index = loaded.ok();
        self.known.insert((texture, encoding), index);
        index
    }

    fn load(
        &mut self,
        texture: usize,
        encoding: Encoding,
        builder: &mut MeshBuilder<'_>,
    ) -> Result<usize, String> {
        let root = self.document.root;
        let texture = root.textures.get(texture).ok_or("missing")?;
        let image = root.get(texture.source).ok_or("no image in a format that is read")?;
        let sampler = texture.sampler.and_then(|sampler| root.get(sampler));
        let wrap = sampler.map_or([Wrap::Repeat; 2], |s| [s.wrap_s, s.wrap_t].map(wrap));
        let file = self.find(texture.source, image)?;
        let key = (file, encoding, wrap);
        if let Some(known) = self.decoded.get(&key) {
            return known.clone();
        }
        let decoded = self.decode(&key.0, image, encoding, wrap).map(|texture| {
            builder.model.textures.push(texture);
            builder.model.textures.len() - 1
        });
        self.decoded.insert(key, decoded.clone());
        decoded
    }

    fn find(&self, index: Index<Image>, image: &Image) -> Result<ImageFile, String> {
        if let Some(view) = image.buffer_view {
            return Ok(ImageFile::View(view));
        }
        let uri = image.uri.as_ref().ok_or("an image without content")?;
        match Content::find(self.document, uri) {
            Ok(Content::File(path)) => Ok(ImageFile::File(path)),
            Ok(Content::Data(_)) => Ok(ImageFile::Data(index)),
            Err(error) => Err(format!("{:?}: {error}", cut(uri))),
        }
    }

    fn decode(
        &mut self,
        file: &ImageFile,
        image: &Image,
        encoding: Encoding,
        wrap: [Wrap; 2],
    ) -> Result<Texture, String> {
        let limit = self.document.request.options.max_bytes;
        let uri = image.uri.as_deref().unwrap_or_default();
        let bytes = match file {
            ImageFile::View(view) => {
                let bytes = self.buffers.view(self.document, *view).map_err(|e| e.to_string())?;
                return self.decoder.decode(bytes, encoding, wrap);
            }
            ImageFile::File(path) => read_file(path, limit),
            ImageFile::Data(_) => Content::Data(uri).read(limit),
        };
        let bytes = bytes.map_err(|error| format!("{:?}: {error}", cut(uri)))?;
        self.decoder.decode(&bytes, encoding, wrap)
    }
}

fn wrap(mode: Checked<WrappingMode>) -> Wrap {
    match mode {
        Checked::Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
        Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
        _ => Wrap::Repeat,
    }
}
