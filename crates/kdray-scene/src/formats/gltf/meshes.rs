//! Meshes into triangles in world space.

use super::accessors::Accessors;
use super::materials::ReadMaterials;
use super::skins::Skin;
use crate::mesh::{Corner, MeshBuilder};
use crate::{LoadError, Place};
use ::gltf::json::mesh::{Mode, Primitive, Semantic};
use ::gltf::json::validation::Checked;
use ::gltf::json::{Accessor, Index};
use glam::{DMat3, DMat4, DVec3};
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::ops::RangeInclusive;
use std::rc::Rc;

/// More triangles or vertices than this do not come of instances: a small file could take all
/// memory.
const MAX_FLATTENED: usize = 1 << 25;

/// A mesh at a place.
pub(super) struct Instance {
    pub(super) mesh: usize,
    pub(super) transform: DMat4,
    /// Takes the place of the transform.
    pub(super) skin: Option<Rc<Skin>>,
}

/// An attribute of each vertex. Primitives may share one.
type Attribute = Rc<Vec<[f64; 4]>>;

/// A primitive as it is in the file.
struct Part {
    path: String,
    positions: Attribute,
    /// Each list is empty or as long as `positions`.
    normals: Attribute,
    uvs: Attribute,
    colors: Attribute,
    joints: Attribute,
    weights: Attribute,
    triangles: Vec<[u32; 3]>,
    material: Option<u32>,
    /// The accessors that tell where vertices are. Primitives of a mesh that have the same share
    /// their vertices.
    sources: [Option<usize>; 3],
}

/// How many triangles the parts of a mesh have, or how many vertices if these are more.
fn size_of(parts: &[Part]) -> usize {
    let vertices: HashMap<_, usize> =
        parts.iter().map(|part| (part.sources, part.positions.len())).collect();
    let triangles: usize = parts.iter().map(|part| part.triangles.len()).sum();
    triangles.max(vertices.values().sum())
}

/// Puts instances of meshes into a model.
pub(super) struct Flattener<'a> {
    accessors: &'a Accessors<'a>,
    materials: &'a ReadMaterials,
    attributes: HashMap<usize, Attribute>,
    meshes: Vec<Option<Rc<Vec<Part>>>>,
    /// Primitives of points or lines, or without positions.
    passed_over: u64,
    morphed: bool,
}

impl<'a> Flattener<'a> {
    pub(super) fn new(accessors: &'a Accessors<'a>, materials: &'a ReadMaterials) -> Self {
        let meshes = vec![None; accessors.document.root.meshes.len()];
        Self {
            accessors,
            materials,
            attributes: HashMap::new(),
            meshes,
            passed_over: 0,
            morphed: false,
        }
    }

    /// Refuses instances that have too many triangles or vertices together.
    pub(super) fn check_size(&mut self, instances: &[Instance]) -> Result<(), LoadError> {
        let mut size = 0;
        let mut sizes = HashMap::new();
        for instance in instances {
            let parts = self.mesh(instance.mesh)?;
            size += *sizes.entry(instance.mesh).or_insert_with(|| size_of(&parts));
            if size > MAX_FLATTENED {
                let path = format!("meshes[{}]", instance.mesh);
                let reason = format!("the instances have more than {MAX_FLATTENED} triangles");
                return Err(self.accessors.document.invalid(&path, reason));
            }
        }
        Ok(())
    }

    pub(super) fn add(
        &mut self,
        instance: &Instance,
        builder: &mut MeshBuilder<'_>,
    ) -> Result<(), LoadError> {
        let parts = self.mesh(instance.mesh)?;
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
        if self.passed_over > 0 {
            let count = self.passed_over;
            builder.warn(format!("primitives of points or lines passed over: {count}"));
        }
        if self.morphed {
            builder.warn("morph targets passed over");
        }
    }

    fn mesh(&mut self, index: usize) -> Result<Rc<Vec<Part>>, LoadError> {
        if let Some(Some(known)) = self.meshes.get(index) {
            return Ok(Rc::clone(known));
        }
        let document = self.accessors.document;
        let path = format!("meshes[{index}]");
        let mesh = document.root.meshes.get(index);
        let mesh = mesh.ok_or_else(|| document.invalid(&path, "missing"))?;
        let mut parts = Vec::new();
        for (number, primitive) in mesh.primitives.iter().enumerate() {
            self.morphed |= primitive.targets.is_some();
            match self.part(primitive, format!("{path}.primitives[{number}]"))? {
                Some(part) => parts.push(part),
                None => self.passed_over += 1,
            }
        }
        let parts = Rc::new(parts);
        self.meshes[index] = Some(Rc::clone(&parts));
        Ok(parts)
    }

    /// None for points, lines and primitives without positions.
    fn part(&mut self, primitive: &Primitive, path: String) -> Result<Option<Part>, LoadError> {
        let Checked::Valid(mode) = primitive.mode else { return Ok(None) };
        let has_triangles =
            matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan);
        let attribute = |semantic| primitive.attributes.get(&Checked::Valid(semantic)).copied();
        let Some(positions) = attribute(Semantic::Positions).filter(|_| has_triangles) else {
            return Ok(None);
        };
        let sources =
            [Some(positions), attribute(Semantic::Joints(0)), attribute(Semantic::Weights(0))];
        let positions = self.attribute(Some(positions), 3..=3)?;
        let count = positions.len();
        let indices = match primitive.indices {
            Some(index) => {
                let indices = self.accessors.vectors::<1>(index, 1..=1)?;
                indices.into_iter().map(|[index]| index as u32).collect()
            }
            None => (0..count as u32).collect::<Vec<_>>(),
        };
        let material = primitive.material.map(|material| material.value());
        let uv_set = material.map_or(0, |material| self.materials.uv_set(material));
        let part = Part {
            positions,
            normals: self.attribute(attribute(Semantic::Normals), 3..=3)?,
            uvs: self.attribute(attribute(Semantic::TexCoords(uv_set)), 2..=2)?,
            colors: self.attribute(attribute(Semantic::Colors(0)), 3..=4)?,
            joints: self.attribute(sources[1], 4..=4)?,
            weights: self.attribute(sources[2], 4..=4)?,
            triangles: triangles(mode, &indices),
            material: material.map(|material| material as u32),
            sources: sources.map(|source| source.map(|index| index.value())),
            path,
        };
        for list in [&part.normals, &part.uvs, &part.colors, &part.joints, &part.weights] {
            if !list.is_empty() && list.len() != count {
                let length = list.len();
                let reason = format!("an attribute of {length} elements for {count} positions");
                return Err(self.accessors.document.invalid(&part.path, reason));
            }
        }
        Ok(Some(part))
    }

    /// The elements of an accessor; none if there is no accessor.
    fn attribute(
        &mut self,
        index: Option<Index<Accessor>>,
        numbers: RangeInclusive<usize>,
    ) -> Result<Attribute, LoadError> {
        let Some(index) = index else { return Ok(Rc::default()) };
        if let Some(known) = self.attributes.get(&index.value()) {
            return Ok(Rc::clone(known));
        }
        let attribute = Rc::new(self.accessors.vectors(index, numbers)?);
        self.attributes.insert(index.value(), Rc::clone(&attribute));
        Ok(attribute)
    }
}

/// The triangles of a list, strip or fan (section 3.7.2.1); a rest is passed over.
fn triangles(mode: Mode, indices: &[u32]) -> Vec<[u32; 3]> {
    match mode {
        Mode::TriangleStrip => indices
            .windows(3)
            .enumerate()
            .map(|(i, w)| if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[0], w[2], w[1]] })
            .collect(),
        Mode::TriangleFan => match indices {
            [hub, rim @ ..] => rim.windows(2).map(|w| [w[0], w[1], *hub]).collect(),
            [] => Vec::new(),
        },
        _ => indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
    }
}

/// How a vertex gets to the world.
struct Placement {
    position: DMat4,
    /// The cofactors of the linear part: the inverse transposed, times the determinant, which also
    /// exists for flat transforms.
    normal: DMat3,
    /// The transform turns left hands into right ones.
    mirrors: bool,
}

impl Placement {
    fn new(position: DMat4) -> Self {
        let [x, y, z] =
            [position.x_axis, position.y_axis, position.z_axis].map(glam::DVec4::truncate);
        let mirrors = x.cross(y).dot(z) < 0.0;
        let sign = if mirrors { -1.0 } else { 1.0 };
        let normal = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign;
        Self { position, normal, mirrors }
    }
}

/// Where each vertex of a part goes.
struct Placements {
    whole: Placement,
    /// By vertex, if the part is skinned.
    skinned: Vec<Placement>,
}

impl Placements {
    fn new(part: &Part, instance: &Instance) -> Self {
        let whole = Placement::new(instance.transform);
        let pairs = part.joints.iter().zip(part.weights.iter());
        let skinned = instance.skin.as_ref().map_or(Vec::new(), |skin| {
            let transforms = pairs.map(|(&joints, &weights)| skin.transform(joints, weights));
            let placed =
                transforms.map(|known| Placement::new(known.unwrap_or(instance.transform)));
            placed.collect()
        });
        Self { whole, skinned }
    }

    fn of(&self, vertex: usize) -> &Placement {
        self.skinned.get(vertex).unwrap_or(&self.whole)
    }
}

fn add_vertices(
    part: &Part,
    instance: &Instance,
    builder: &mut MeshBuilder<'_>,
) -> Result<(), LoadError> {
    let placements = Placements::new(part, instance);
    for (vertex, p) in part.positions.iter().enumerate() {
        let placement = placements.of(vertex);
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
    // So that messages number vertices as the file does.
    builder.first_index = -(base as i64);
    let corner = |index: u32| {
        let i = index as usize;
        let normal = part.normals.get(i).map(|n| {
            let normal = placements.of(i).normal * DVec3::new(n[0], n[1], n[2]);
            normal.normalize_or_zero().as_vec3().into()
        });
        let color = part.colors.get(i).map(|c| [c[0], c[1], c[2]].map(|x| x as f32));
        let uv = part.uvs.get(i).map(|uv| [uv[0], uv[1]].map(|x| x as f32));
        Corner { vertex: (base + i) as i64, normal, uv, color }
    };
    for (number, triangle) in part.triangles.iter().enumerate() {
        let place = || Place::Json(format!("{} triangle {number}", part.path));
        if let Some(bad) = triangle.iter().find(|&&i| i as usize >= part.positions.len()) {
            let count = part.positions.len();
            let reason = format!("vertex index {bad} is out of range: there are {count} vertices");
            builder.refuse_or_drop(place(), reason)?;
            continue;
        }
        let mut corners = triangle.map(corner);
        if placements.of(triangle[0] as usize).mirrors {
            corners.swap(1, 2);
        }
        builder.polygon(&corners, place)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_keep_their_winding() {
        let strip = triangles(Mode::TriangleStrip, &[0, 1, 2, 3]);
        assert_eq!(strip, [[0, 1, 2], [1, 3, 2]]);
        let fan = triangles(Mode::TriangleFan, &[0, 1, 2, 3]);
        assert_eq!(fan, [[1, 2, 0], [2, 3, 0]]);
        let list = triangles(Mode::Triangles, &[0, 1, 2, 3, 4]);
        assert_eq!(list, [[0, 1, 2]]);
    }

    #[test]
    fn mirrors_are_known_and_normals_stay_outside() {
        let mirror = Placement::new(DMat4::from_scale(DVec3::new(-2.0, 1.0, 1.0)));
        assert!(mirror.mirrors);
        assert!((mirror.normal * DVec3::X).x < 0.0, "the side that faced +x now faces -x");
        assert!((mirror.normal * DVec3::Y).y > 0.0);
        let turned = Placement::new(DMat4::from_scale(DVec3::new(-1.0, -1.0, 1.0)));
        assert!(!turned.mirrors);
    }
}
