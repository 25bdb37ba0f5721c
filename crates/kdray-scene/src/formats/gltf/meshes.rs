//! Meshes into triangles in world space.

use super::Document;
use super::accessors::Accessors;
use super::materials::ReadMaterials;
use super::parts::{Part, Parts};
use super::placement::Placements;
use super::skins::Skin;
use crate::mesh::{Corner, MeshBuilder};
use crate::{LoadError, Place};
use glam::{DMat4, DVec3};
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::rc::Rc;

/// More triangles or vertices than this do not come of instances: a small file could take all
/// memory. Nor do more primitives, which could take all day.
const MAX_FLATTENED: usize = 1 << 25;

/// A mesh at a place.
pub(super) struct Instance {
    pub(super) mesh: usize,
    pub(super) transform: DMat4,
    /// Takes the place of the transform.
    pub(super) skin: Option<Rc<Skin>>,
}

/// How many triangles the parts of a mesh have, or how many vertices if these are more, or how
/// many parts if there are more of them.
fn size_of(parts: &[Part]) -> usize {
    let vertices: HashMap<_, usize> =
        parts.iter().map(|part| (part.sources, part.vertices.len())).collect();
    let triangles: usize = parts.iter().map(|part| part.triangles.len()).sum();
    triangles.max(vertices.values().sum()).max(parts.len())
}

/// Puts instances of meshes into a model.
pub(super) struct Flattener<'a> {
    document: Document<'a>,
    parts: Parts<'a>,
}

impl<'a> Flattener<'a> {
    pub(super) fn new(accessors: &'a Accessors<'a>, materials: &'a ReadMaterials) -> Self {
        Self { document: accessors.document, parts: Parts::new(accessors, materials) }
    }

    /// Refuses instances that have too many triangles or vertices together.
    pub(super) fn check_size(&mut self, instances: &[Instance]) -> Result<(), LoadError> {
        let mut size = 0;
        let mut sizes = HashMap::new();
        for instance in instances {
            let parts = self.parts.of_mesh(instance.mesh)?;
            size += *sizes.entry(instance.mesh).or_insert_with(|| size_of(&parts));
            if size > MAX_FLATTENED {
                let path = format!("meshes[{}]", instance.mesh);
                let reason = format!(
                    "the instances have more than {MAX_FLATTENED} triangles, vertices or primitives"
                );
                return Err(self.document.invalid(&path, reason));
            }
        }
        Ok(())
    }

    pub(super) fn add(
        &mut self,
        instance: &Instance,
        builder: &mut MeshBuilder<'_>,
    ) -> Result<(), LoadError> {
        let parts = self.parts.of_mesh(instance.mesh)?;
        let mut bases = HashMap::new();
        for part in parts.iter() {
            let base = match bases.entry(part.sources) {
                Entry::Occupied(base) => *base.get(),
                Entry::Vacant(new) => {
                    let base = *new.insert(builder.model.vertices.len());
                    add_vertices(part, instance, builder)?;
                    base
                }
            };
            add_triangles(part, instance, base, builder)?;
        }
        Ok(())
    }

    pub(super) fn finish(self, builder: &mut MeshBuilder<'_>) {
        self.parts.finish(builder);
    }
}

fn add_vertices(
    part: &Part,
    instance: &Instance,
    builder: &mut MeshBuilder<'_>,
) -> Result<(), LoadError> {
    let placements = Placements::new(part, instance);
    for vertex in part.vertices.iter().map(|&vertex| vertex as usize) {
        let (p, placement) = (part.positions[vertex], placements.of(vertex));
        let position = placement.position.transform_point3(DVec3::new(p[0], p[1], p[2]));
        builder.vertex(position.as_vec3().into(), || Place::Json(part.path.clone()))?;
    }
    Ok(())
}

fn add_triangles(
    part: &Part,
    instance: &Instance,
    base: usize,
    builder: &mut MeshBuilder<'_>,
) -> Result<(), LoadError> {
    let placements = Placements::new(part, instance);
    builder.material = part.material;
    let corner = |index: u32| {
        let i = part.vertices[index as usize] as usize;
        let normal = part.normals.get(i).map(|n| {
            let normal = placements.of(i).normal * DVec3::new(n[0], n[1], n[2]);
            normal.normalize_or_zero().as_vec3().into()
        });
        let color = part.colors.get(i).map(|c| [c[0], c[1], c[2]].map(|x| x as f32));
        let uv = part.uvs.get(i).map(|uv| [uv[0], uv[1]].map(|x| x as f32));
        Corner { vertex: (base + index as usize) as i64, normal, uv, color }
    };
    for (number, triangle) in part.triangles.iter().enumerate() {
        let place = || Place::Json(format!("{} triangle {number}", part.path));
        if let Some(reason) = reason_against(triangle, part, &builder.model.vertices[base..]) {
            builder.refuse_or_drop(place(), reason)?;
            continue;
        }
        let mut corners = triangle.map(corner);
        if placements.of(part.vertices[triangle[0] as usize] as usize).mirrors {
            corners.swap(1, 2);
        }
        builder.polygon(&corners, place)?;
    }
    Ok(())
}

/// What is wrong with a triangle of a part whose vertices were placed, in the file's numbers.
fn reason_against(triangle: &[u32; 3], part: &Part, placed: &[[f32; 3]]) -> Option<String> {
    let count = part.positions.len();
    if let Some(bad) = triangle.iter().find(|&&i| i as usize >= count) {
        return Some(format!("vertex index {bad} is out of range: there are {count} vertices"));
    }
    let is_bad = |&&i: &&u32| !placed[i as usize].iter().all(|x| x.is_finite());
    let bad = *triangle.iter().find(is_bad)? as usize;
    Some(format!("vertex {} at {:?} is not finite", part.vertices[bad], placed[bad]))
}
