//! What the materials of the libraries mean for the renderer.

use super::Request;
use super::mtl::{self, Map, Statements};
use crate::input::{Limited, Scanner, peek, read_file, utf8};
use crate::mesh::MeshBuilder;
use crate::textures::{Encoding, TextureDecoder};
use crate::{AlphaMode, LoadError, Material, TextureRef, Wrap};
use std::collections::{BTreeSet, HashMap, HashSet};
use std::fs::File;
use std::io::{self, ErrorKind};
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
        let mut maps = Maps { textures: TextureDecoder::default(), known: HashMap::new(), request };
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
            Ok(path) if known.contains(&path) => Ok(()),
            Ok(path) => {
                let read = read_library(name, &path, request, &mut materials);
                known.insert(path);
                read
            }
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

/// Textures by their files, so that each is read once; none for one that failed.
struct Maps<'a> {
    textures: TextureDecoder,
    /// By the path, or by the name of a file that is not there.
    known: HashMap<(PathBuf, bool), Option<usize>>,
    request: &'a Request<'a>,
}

impl Maps<'_> {
    fn texture(&mut self, map: &Map, builder: &mut MeshBuilder<'_>) -> Option<TextureRef> {
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
                builder.warn(format!("texture {:?} left out: {reason}", map.file));
                None
            }
        }
    }
}

/// Statements in the words of the renderer.
fn material(
    statements: &Statements,
    maps: &mut Maps<'_>,
    builder: &mut MeshBuilder<'_>,
) -> Material {
    let plain = Material::default();
    let unit = |color: [f32; 3]| color.map(|x| x.clamp(0.0, 1.0));
    let illumination = statements.illumination.unwrap_or(2.0) as i32;
    let mut material = Material {
        name: statements.name.clone(),
        base_color: statements.diffuse.map_or(plain.base_color, unit),
        metallic: statements.metallic.unwrap_or(0.0).clamp(0.0, 1.0),
        roughness: statements.roughness.or(statements.shininess.map(roughness)).unwrap_or(0.6),
        specular: statements.specular.map_or(plain.specular, unit),
        emission: statements.emission.unwrap_or_default().map(|x| x.max(0.0)),
        ior: statements.ior.filter(|&ior| ior >= 1.0).unwrap_or(plain.ior),
        ..plain
    };
    material.roughness = material.roughness.clamp(0.0, 1.0);
    match illumination {
        // Colour or diffuse light alone.
        0 | 1 => material.specular = [0.0; 3],
        // Ray-traced mirrors.
        3 | 5 => material.mirror = material.specular,
        // Glass: its colour is the hue of the filter, for the amount means different things to
        // different programs.
        4 | 6 | 7 => {
            material.transmission = 1.0;
            material.base_color = statements.filter.map_or([1.0; 3], hue);
        }
        _ => {}
    }
    if material.transmission == 0.0 {
        set_opacity(&mut material, statements, builder);
    }
    if let Some(map) = &statements.diffuse_map {
        material.base_color_texture = maps.texture(map, builder);
        // Programs that write a map often leave its factor black.
        if material.base_color_texture.is_some() && material.base_color == [0.0; 3] {
            material.base_color = [1.0; 3];
        }
    }
    if let Some(map) = &statements.emission_map {
        material.emission_texture = maps.texture(map, builder);
        if material.emission_texture.is_some() && statements.emission.is_none() {
            material.emission = [1.0; 3];
        }
    }
    material
}

/// `d` is opacity, `Tr` is 1 − `d`; but old versions of MeshLab wrote `Tr 1` for opaque surfaces,
/// and nobody describes invisible ones.
fn set_opacity(material: &mut Material, statements: &Statements, builder: &mut MeshBuilder<'_>) {
    let from_tr = statements.transparency.map(|tr| 1.0 - tr);
    let opacity = match (statements.dissolve, from_tr) {
        (None, Some(opacity)) if opacity <= 0.0 => {
            let name = &material.name;
            builder.warn(format!("material {name:?}: `Tr 1` without `d` taken as opaque"));
            1.0
        }
        (dissolve, from_tr) => dissolve.or(from_tr).unwrap_or(1.0).clamp(0.0, 1.0),
    };
    material.opacity = opacity;
    if opacity < 1.0 {
        material.alpha_mode = AlphaMode::Blend;
    }
}

/// The roughness with which a highlight is as wide as with this Phong exponent: α² = 2 / (n + 2)
/// (Walter et al. 2007, section 5.2) with α = roughness².
fn roughness(exponent: f32) -> f32 {
    (2.0 / (exponent.max(0.0) + 2.0)).powf(0.25)
}

/// The colour with its largest channel at 1.
fn hue(color: [f32; 3]) -> [f32; 3] {
    let largest = color.into_iter().fold(0.0, f32::max);
    if largest > 0.0 { color.map(|x| (x / largest).clamp(0.0, 1.0)) } else { [1.0; 3] }
}
