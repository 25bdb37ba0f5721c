//! Faces, and the lists that they point into.

use super::Request;
use crate::mesh::{Corner, MeshBuilder};
use crate::{LoadError, Place};

/// Normals, texture coordinates and colours so far, and the faces that must wait for more.
#[derive(Default)]
pub(super) struct Faces {
    pub(super) normals: Vec<[f32; 3]>,
    /// (0, 0) is the image's upper left.
    pub(super) uvs: Vec<[f32; 2]>,
    /// As many as vertices up to the last coloured one.
    pub(super) colors: Vec<[f32; 3]>,
    waiting: Vec<Face>,
    missing_attributes: u64,
    /// Kept from one face to the next for their memory.
    indices: Vec<Indices>,
    corners: Vec<Corner>,
}

/// The indices at a corner, from 0, perhaps out of range.
#[derive(Clone, Copy)]
struct Indices {
    vertex: i64,
    uv: Option<i64>,
    normal: Option<i64>,
}

struct Face {
    line: u64,
    material: Option<u32>,
    corners: Vec<Indices>,
}

impl Faces {
    /// Adds the face that a statement describes. If it points at things that come later in the
    /// file, it is added at the end.
    pub(super) fn add(
        &mut self,
        line: u64,
        words: &str,
        builder: &mut MeshBuilder<'_>,
        request: &Request<'_>,
    ) -> Result<(), LoadError> {
        let counts = [builder.model.vertices.len(), self.uvs.len(), self.normals.len()];
        let corner = |word: &str| {
            corner_indices(word, counts).ok_or_else(|| {
                let word: String = word.chars().take(40).collect();
                let reason =
                    format!("{word:?} is no corner of a face, such as 1, 1/2, 1//3 or 1/2/3");
                request.invalid(Place::Line(line), reason)
            })
        };
        let mut corners = std::mem::take(&mut self.indices);
        corners.clear();
        for word in words.split_whitespace() {
            corners.push(corner(word)?);
        }
        let is_known = |index: i64, count: usize| index < count as i64;
        let all_known = corners.iter().all(|corner| {
            is_known(corner.vertex, counts[0])
                && corner.uv.is_none_or(|index| is_known(index, counts[1]))
                && corner.normal.is_none_or(|index| is_known(index, counts[2]))
        });
        if all_known {
            self.build(line, &corners, builder)?;
            self.indices = corners;
        } else {
            self.waiting.push(Face { line, material: builder.material, corners });
        }
        Ok(())
    }

    /// Adds the faces that have waited.
    pub(super) fn finish(&mut self, builder: &mut MeshBuilder<'_>) -> Result<(), LoadError> {
        for face in std::mem::take(&mut self.waiting) {
            builder.material = face.material;
            self.build(face.line, &face.corners, builder)?;
        }
        if self.missing_attributes > 0 {
            let count = self.missing_attributes;
            builder.warn(format!("{count} corners have normals or uvs that are not in the file"));
        }
        Ok(())
    }

    fn build(
        &mut self,
        line: u64,
        face: &[Indices],
        builder: &mut MeshBuilder<'_>,
    ) -> Result<(), LoadError> {
        let mut corners = std::mem::take(&mut self.corners);
        corners.clear();
        corners.extend(face.iter().map(|&corner| self.corner(corner)));
        let added = builder.polygon(&corners, || Place::Line(line));
        self.corners = corners;
        added
    }

    fn corner(&mut self, indices: Indices) -> Corner {
        let normal = indices.normal.map(|index| get(&self.normals, index));
        let uv = indices.uv.map(|index| get(&self.uvs, index));
        self.missing_attributes += u64::from(normal == Some(None) || uv == Some(None));
        let color = get(&self.colors, indices.vertex);
        Corner { vertex: indices.vertex, normal: normal.flatten(), uv: uv.flatten(), color }
    }
}

fn get<T: Copy>(list: &[T], index: i64) -> Option<T> {
    list.get(usize::try_from(index).ok()?).copied()
}

/// `vertex`, `vertex/uv`, `vertex//normal` or `vertex/uv/normal`, counted from 1, or back from the
/// last one so far as −1.
fn corner_indices(word: &str, [vertices, uvs, normals]: [usize; 3]) -> Option<Indices> {
    let mut parts = word.split('/');
    let vertex = index(parts.next()?, vertices)?;
    let mut optional = |count| match parts.next() {
        None | Some("") => Some(None),
        Some(part) => index(part, count).map(Some),
    };
    let (uv, normal) = (optional(uvs)?, optional(normals)?);
    parts.next().is_none().then_some(Indices { vertex, uv, normal })
}

/// An index from 0; negative if it points before the first.
fn index(word: &str, count: usize) -> Option<i64> {
    match word.parse::<i64>().ok()? {
        0 => None,
        back if back < 0 => Some((count as i64).saturating_add(back)),
        number => Some(number - 1),
    }
}
