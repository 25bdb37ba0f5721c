//! Which extensions are read.

use super::Document;
use crate::{LoadError, Place};

const READ: [&str; 10] = [
    "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// Refuses a document that requires an extension which is not read; gives the names of those that
/// it uses without requiring them.
pub(super) fn check(document: Document<'_>) -> Result<Vec<String>, LoadError> {
    let root = document.root;
    let is_unread = |name: &&String| !READ.contains(&name.as_str());
    let required: Vec<&String> = root.extensions_required.iter().filter(is_unread).collect();
    if !required.is_empty() {
        let list: Vec<&str> = required.iter().map(|name| name.as_str()).collect();
        return Err(LoadError::Unsupported {
            file: document.request.file.to_owned(),
            place: Place::Json("extensionsRequired".to_owned()),
            what: format!("the extension {}", list.join(", ")),
        });
    }
    Ok(root.extensions_used.iter().filter(is_unread).cloned().collect())
}
