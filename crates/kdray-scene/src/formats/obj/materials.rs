//! The materials that faces name, from their libraries.

use super::Request;
use super::maps::Maps;
use super::material::material;
use super::mtl::{self, Statements};
use crate::input::{Limited, Scanner, peek, utf8};
use crate::mesh::MeshBuilder;
use crate::{LoadError, Material};
use std::collections::{BTreeSet, HashMap, HashSet};
use std::fs::File;
use std::path::{Path, PathBuf};

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
        let mut known = HashSet::new();
        for (line, names) in &self.libraries {
            for statements in read_libraries(*line, names, &mut known, builder, request) {
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
                    builder.warn(format!("the material {name:?} is not defined"));
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

/// The materials of the library, or of several libraries with spaces between their names; none of
/// those that are known from statements before.
fn read_libraries(
    line: u64,
    names: &str,
    known: &mut HashSet<PathBuf>,
    builder: &mut MeshBuilder<'_>,
    request: &Request<'_>,
) -> Vec<Statements> {
    let mut materials = Vec::new();
    let is_one = request.siblings.find(names).is_ok();
    let several: Vec<&str> = if is_one { vec![names] } else { names.split_whitespace().collect() };
    for name in several {
        let read = match request.siblings.find(name) {
            Ok(path) if known.insert(path.clone()) => {
                read_library(name, &path, request, &mut materials)
            }
            Ok(_) => Ok(()),
            Err(error) => Err(LoadError::Io { file: name.to_owned(), error }),
        };
        if let Err(error) = read {
            builder.warn(format!("line {line}: material library left out: {error}"));
        }
    }
    materials
}

fn read_library(
    name: &str,
    path: &Path,
    request: &Request<'_>,
    materials: &mut Vec<Statements>,
) -> Result<(), LoadError> {
    let library = Request { file: name, ..*request };
    let fail = |error| library.read_error(error);
    let file = Limited::new(File::open(path).map_err(fail)?, request.options.max_bytes);
    let (start, bytes) = peek(Box::new(file), 4).map_err(fail)?;
    let bytes = utf8(bytes, &start).map_err(fail)?;
    let mut scanner = Scanner::new(bytes, &library);
    let mut line = Vec::new();
    while scanner.line(&mut line)? {
        mtl::add_line(&String::from_utf8_lossy(&line), materials);
    }
    Ok(())
}
