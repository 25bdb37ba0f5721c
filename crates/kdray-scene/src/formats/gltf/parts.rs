//! Primitives as they are in the file.

use super::accessors::Accessors;
use super::materials::ReadMaterials;
use super::used::UsedVertices;
use crate::LoadError;
use crate::mesh::MeshBuilder;
use ::gltf::json::mesh::{Mode, Primitive, Semantic};
use ::gltf::json::validation::Checked;
use ::gltf::json::{Accessor, Index};
use std::collections::HashMap;
use std::ops::RangeInclusive;
use std::rc::Rc;

/// An attribute of each vertex. Primitives may share one.
type Attribute = Rc<Vec<[f64; 4]>>;

/// A primitive of triangles.
pub(super) struct Part {
    /// For messages.
    pub(super) path: String,
    pub(super) positions: Attribute,
    /// Each list is empty or as long as `positions`.
    pub(super) normals: Attribute,
    pub(super) uvs: Attribute,
    pub(super) colors: Attribute,
    pub(super) joints: Attribute,
    pub(super) weights: Attribute,
    /// The vertices that triangles use, in the file's order; parts of the same sources have them
    /// together.
    pub(super) vertices: Rc<Vec<u32>>,
    /// Indices into `vertices`; but where one is out of the range of `positions`, all three are as
    /// in the file.
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) material: Option<u32>,
    /// The accessors that tell where vertices are. Primitives of a mesh that have the same share
    /// their vertices.
    pub(super) sources: [Option<usize>; 3],
}

/// Reads the parts of meshes, each mesh and attribute once.
pub(super) struct Parts<'a> {
    accessors: &'a Accessors<'a>,
    materials: &'a ReadMaterials,
    attributes: HashMap<usize, Attribute>,
    used: UsedVertices,
    meshes: Vec<Option<Rc<Vec<Part>>>>,
    /// Primitives of points or lines, or without positions.
    passed_over: u64,
    morphed: bool,
}

impl<'a> Parts<'a> {
    pub(super) fn new(accessors: &'a Accessors<'a>, materials: &'a ReadMaterials) -> Self {
        let meshes = vec![None; accessors.document.root.meshes.len()];
        let (attributes, used) = (HashMap::new(), UsedVertices::default());
        Self { accessors, materials, attributes, used, meshes, passed_over: 0, morphed: false }
    }

    pub(super) fn of_mesh(&mut self, index: usize) -> Result<Rc<Vec<Part>>, LoadError> {
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
        self.used.number(&mut parts);
        let parts = Rc::new(parts);
        self.meshes[index] = Some(Rc::clone(&parts));
        Ok(parts)
    }

    /// Warns of what was passed over.
    pub(super) fn finish(self, builder: &mut MeshBuilder<'_>) {
        if self.passed_over > 0 {
            let count = self.passed_over;
            builder.warn(format!("primitives of points or lines passed over: {count}"));
        }
        if self.morphed {
            builder.warn("morph targets passed over");
        }
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
        let indices = self.indices(primitive, positions.len(), &path)?;
        let material = primitive.material.map(|material| material.value());
        let uv_set = material.map_or(0, |material| self.materials.uv_set(material));
        let part = Part {
            positions,
            normals: self.attribute(attribute(Semantic::Normals), 3..=3)?,
            uvs: self.attribute(attribute(Semantic::TexCoords(uv_set)), 2..=2)?,
            colors: self.attribute(attribute(Semantic::Colors(0)), 3..=4)?,
            joints: self.attribute(sources[1], 4..=4)?,
            weights: self.attribute(sources[2], 4..=4)?,
            vertices: Rc::default(),
            triangles: triangles(mode, &indices),
            material: material.map(|material| material as u32),
            sources: sources.map(|source| source.map(|index| index.value())),
            path,
        };
        self.check_lengths(&part)?;
        Ok(Some(part))
    }

    /// The stated indices, or one for each of `count` positions.
    fn indices(
        &self,
        primitive: &Primitive,
        count: usize,
        path: &str,
    ) -> Result<Vec<u32>, LoadError> {
        if let Some(index) = primitive.indices {
            let indices = self.accessors.vectors::<1>(index, 1..=1)?;
            return Ok(indices.into_iter().map(|[index]| index as u32).collect());
        }
        // Many primitives may show the same positions.
        self.accessors.charge(count as u64, path)?;
        Ok((0..count as u32).collect())
    }

    fn check_lengths(&self, part: &Part) -> Result<(), LoadError> {
        let count = part.positions.len();
        for list in [&part.normals, &part.uvs, &part.colors, &part.joints, &part.weights] {
            if !list.is_empty() && list.len() != count {
                let length = list.len();
                let reason = format!("an attribute of {length} elements for {count} positions");
                return Err(self.accessors.document.invalid(&part.path, reason));
            }
        }
        Ok(())
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
}
