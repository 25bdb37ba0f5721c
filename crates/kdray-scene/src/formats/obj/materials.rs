//! The materials that faces name, from their libraries.

use super::Request;
use super::libraries::Libraries;
use super::maps::Maps;
use super::material::material;
use crate::Material;
use crate::cut::cut;
use crate::mesh::MeshBuilder;
use std::collections::{BTreeSet, HashMap};

/// The materials that faces use, in the order of their first use.
#[derive(Default)]
pub(super) struct Materials {
    names: Vec<String>,
    ids: HashMap<String, u32>,
    /// The `mtllib` statements and their lines.
    pub(super) libraries: Vec<(u64, String)>,
}

impl Materials {
    /// The index of the material of this name.
    pub(super) fn id(&mut self, name: &str) -> u32 {
        if let Some(&id) = self.ids.get(name) {
            return id;
        }
        let id = self.names.len() as u32;
        self.names.push(name.to_owned());
        self.ids.insert(name.to_owned(), id);
        id
    }

    /// Reads the libraries and adds the materials in use to the model. What is missing or wrong
    /// becomes a warning.
    pub(super) fn finish(self, builder: &mut MeshBuilder<'_>, request: &Request<'_>) {
        let mut defined = HashMap::new();
        let mut libraries = Libraries::new(request);
        for (line, names) in &self.libraries {
            for statements in libraries.read(*line, names, builder) {
                // Of several definitions the first counts.
                defined.entry(statements.name.clone()).or_insert(statements);
            }
        }
        let mut maps = Maps::new(request);
        let mut ignored = BTreeSet::new();
        for name in self.names {
            let material = match defined.get(&name) {
                Some(statements) => {
                    ignored.extend(statements.other_maps.iter().cloned());
                    material(statements, &mut maps, builder)
                }
                None => {
                    let warning = format!("the material {:?} is not defined", cut(&name));
                    builder.warn_often("materials not defined", warning);
                    Material { name, ..Material::default() }
                }
            };
            builder.model.materials.push(material);
        }
        if !ignored.is_empty() {
            let list: Vec<String> = ignored.into_iter().collect();
            builder.warn(format!("maps of materials passed over: {}", list.join(", ")));
        }
    }
}
