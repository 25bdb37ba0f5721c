//! glTF 2.0 and GLB (Khronos, ISO/IEC 12113), flattened to world space.
//!
//! The JSON is read by the `gltf` crate's types and checked by its rules; buffers, accessors and
//! the scene graph by hand, for the crate's readers panic or loop where a file breaks the rules.

mod accessors;
mod buffers;
mod container;
mod content;
mod extensions;
mod graph;
mod lamps;
mod materials;
mod meshes;
mod parts;
mod placement;
mod skins;
mod textures;
mod used;

use super::Request;
use crate::mesh::MeshBuilder;
use crate::{LoadError, Model, Place};
use ::gltf::json::Root;
use accessors::Accessors;
use buffers::Buffers;
use graph::Graph;
use materials::Materials;
use meshes::{Flattener, Instance};
use skins::Skins;
use std::io::Read;

/// A checked document and the means to report on it.
#[derive(Clone, Copy)]
struct Document<'a> {
    root: &'a Root,
    request: &'a Request<'a>,
}

impl Document<'_> {
    /// An error at a path in the JSON.
    fn invalid(&self, path: &str, reason: impl Into<String>) -> LoadError {
        self.request.invalid(Place::Json(path.to_owned()), reason)
    }
}

pub(super) fn read(
    bytes: Box<dyn Read + '_>,
    start: &[u8],
    request: &Request<'_>,
) -> Result<Model, LoadError> {
    let container = container::read(bytes, start, request)?;
    let document = Document { root: &container.root, request };
    let unread = extensions::check(document)?;
    container::validate(document)?;
    let mut builder = MeshBuilder::new(request);
    if !unread.is_empty() {
        builder.warn(format!("extensions passed over: {}", unread.join(", ")));
    }
    let graph = Graph::new(document)?;
    let buffers = Buffers::load(document, container.binary)?;
    let accessors = Accessors::new(document, &buffers);
    let materials = Materials::new(document, &buffers).read(&mut builder)?;
    let mut flattener = Flattener::new(&accessors, &materials);
    let mut skins = Skins::new(&accessors, &graph);
    let mut instances = Vec::new();
    for node in &graph.visited {
        lamps::add_camera(document, node, &mut builder);
        lamps::add_light(document, node, &mut builder);
        let Some(mesh) = document.root.nodes[node.index].mesh else { continue };
        let skin = skins.of_node(node.index)?;
        for transform in graph::instances(&accessors, node)? {
            instances.push(Instance { mesh: mesh.value(), transform, skin: skin.clone() });
        }
    }
    flattener.check_size(&instances)?;
    for instance in &instances {
        flattener.add(instance, &mut builder)?;
    }
    flattener.finish(&mut builder);
    Ok(builder.finish())
}
