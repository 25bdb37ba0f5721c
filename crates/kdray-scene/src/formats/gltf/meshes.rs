//! Meshes into triangles in world space.

use super::accessors::Accessors;
use super::materials::ReadMaterials;
use super::skins::Skin;
use crate::mesh::{Corner, MeshBuilder};
use crate::{LoadError, Place};
use ::gltf::json::mesh::{Mode, Primitive, Semantic};
use ::gltf::json::validation::Checked;
use glam::{DMat3, DMat4, DVec3};
use std::rc::Rc;

/// More triangles or vertices than this do not come of instances: a small file could take all
/// memory.
const MAX_FLATTENED: usize = 1 << 25;

/// A mesh at a place.
pub(super) struct Instance<'a> {
    pub(super) mesh: usize,
    pub(super) transform: DMat4,
    /// Takes the place of the transform.
    pub(super) skin: Option<&'a Skin>,
}

/// A primitive as it is in the file.
struct Part {
    path: String,
    positions: Vec<[f64; 3]>,
    /// Each list is empty or as long as `positions`.
    normals: Vec<[f64; 3]>,
    uvs: Vec<[f64; 2]>,
    colors: Vec<[f64; 4]>,
    joints: Vec<[f64; 4]>,
    weights: Vec<[f64; 4]>,
    triangles: Vec<[u32; 3]>,
    material: Option<u32>,
}

/// Puts instances of meshes into a model.
pub(super) struct Flattener<'a> {
    accessors: Accessors<'a>,
    materials: &'a ReadMaterials,
    meshes: Vec<Option<Rc<Vec<Part>>>>,
    /// Primitives of points or lines, or without positions.
    passed_over: u64,
    morphed: bool,
}

impl<'a> Flattener<'a> {
    pub(super) fn new(accessors: Accessors<'a>, materials: &'a ReadMaterials) -> Self {
        let meshes = vec![None; accessors.document.root.meshes.len()];
        Self { accessors, materials, meshes, passed_over: 0, morphed: false }
    }

    pub(super) fn add(
        &mut self,
        instance: &Instance<'_>,
        builder: &mut MeshBuilder<'_>,
    ) -> Result<(), LoadError> {
        let parts = self.mesh(instance.mesh)?;
        for part in parts.iter() {
            let model = &builder.model;
            let triangles = model.triangles.len() + part.triangles.len();
            let vertices = model.vertices.len() + part.positions.len();
            if triangles.max(vertices) > MAX_FLATTENED {
                let reason = format!("the instances have more than {MAX_FLATTENED} triangles");
                return Err(self.accessors.document.invalid(&part.path, reason));
            }
            add_part(part, instance, builder)?;
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
    fn part(&self, primitive: &Primitive, path: String) -> Result<Option<Part>, LoadError> {
        let Checked::Valid(mode) = primitive.mode else { return Ok(None) };
        let has_triangles =
            matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan);
        let attribute = |semantic| primitive.attributes.get(&Checked::Valid(semantic)).copied();
        let Some(positions) = attribute(Semantic::Positions).filter(|_| has_triangles) else {
            return Ok(None);
        };
        let positions = self.accessors.vectors::<3>(positions, 3)?;
        let count = positions.len();
        let indices = match primitive.indices {
            Some(index) => {
                let indices = self.accessors.vectors::<1>(index, 1)?;
                indices.into_iter().map(|[index]| index as u32).collect()
            }
            None => (0..count as u32).collect::<Vec<_>>(),
        };
        let material = primitive.material.map(|material| material.value());
        let uv_set = material.map_or(0, |material| self.materials.uv_set(material));
        Ok(Some(Part {
            positions,
            normals: self.list(attribute(Semantic::Normals), 3, count, &path)?,
            uvs: self.list(attribute(Semantic::TexCoords(uv_set)), 2, count, &path)?,
            colors: self.list(attribute(Semantic::Colors(0)), 3, count, &path)?,
            joints: self.list(attribute(Semantic::Joints(0)), 4, count, &path)?,
            weights: self.list(attribute(Semantic::Weights(0)), 4, count, &path)?,
            triangles: triangles(mode, &indices),
            material: material.map(|material| material as u32),
            path,
        }))
    }

    fn list<const N: usize>(
        &self,
        index: Option<::gltf::json::Index<::gltf::json::Accessor>>,
        least: usize,
        count: usize,
        path: &str,
    ) -> Result<Vec<[f64; N]>, LoadError> {
        let Some(index) = index else { return Ok(Vec::new()) };
        let list = self.accessors.vectors(index, least)?;
        if list.len() != count {
            let length = list.len();
            let reason = format!("an attribute of {length} elements for {count} positions");
            return Err(self.accessors.document.invalid(path, reason));
        }
        Ok(list)
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

fn add_part(
    part: &Part,
    instance: &Instance<'_>,
    builder: &mut MeshBuilder<'_>,
) -> Result<(), LoadError> {
    let whole = Placement::new(instance.transform);
    let is_skinned = !part.joints.is_empty() && !part.weights.is_empty();
    let skin = instance.skin.filter(|_| is_skinned);
    let skinned: Vec<Placement> = skin.map_or(Vec::new(), |skin| {
        let pairs = part.joints.iter().zip(&part.weights);
        let transforms = pairs.map(|(&joints, &weights)| skin.transform(joints, weights));
        transforms
            .map(|transform| Placement::new(transform.unwrap_or(instance.transform)))
            .collect()
    });
    let placement = |vertex: usize| skinned.get(vertex).unwrap_or(&whole);
    let base = builder.model.vertices.len();
    for (vertex, &position) in part.positions.iter().enumerate() {
        let placed = placement(vertex).position.transform_point3(DVec3::from(position));
        builder.model.vertices.push(placed.as_vec3().into());
    }
    builder.material = part.material;
    // So that messages number vertices as the file does.
    builder.first_index = -(base as i64);
    let corner = |index: u32| {
        let i = index as usize;
        let normal = part.normals.get(i).map(|&normal| {
            (placement(i).normal * DVec3::from(normal)).normalize_or_zero().as_vec3().into()
        });
        let color = part.colors.get(i).map(|c| [c[0], c[1], c[2]].map(|x| x as f32));
        let uv = part.uvs.get(i).map(|uv| uv.map(|x| x as f32));
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
        if placement(triangle[0] as usize).mirrors {
            corners.swap(1, 2);
        }
        builder.polygon(&corners, place)?;
    }
    Ok(())
}
