//! Putting shapes together to a model.

use crate::{Material, Model, Texture, TextureRef};
use glam::{DAffine3, DVec3};

/// A corner of a triangle in a shape's own space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub(super) position: DVec3,
    /// The shading normal, of any length.
    pub(super) normal: DVec3,
    pub(super) uv: [f64; 2],
}

/// A shape: corners, and three indices into them a triangle, counter-clockwise seen from outside.
#[derive(Clone, Debug, Default)]
pub(super) struct Shape {
    pub(super) corners: Vec<Corner>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// A model in the making, whose every triangle has a material, normals and texture coordinates.
#[derive(Debug, Default)]
pub(super) struct Assembly {
    pub(super) model: Model,
}

impl Assembly {
    /// Adds a texture, and returns how a material refers to it.
    pub(super) fn texture(&mut self, texture: Texture, repeats: f32) -> TextureRef {
        self.model.textures.push(texture);
        let transform = [[repeats, 0.0, 0.0], [0.0, repeats, 0.0]];
        TextureRef { texture: self.model.textures.len() - 1, transform }
    }

    /// Adds a material, and returns its index.
    pub(super) fn material(&mut self, material: Material) -> u32 {
        self.model.materials.push(material);
        self.model.materials.len() as u32 - 1
    }

    /// Adds a shape of one material, moved by a rotation, an even scale and a translation.
    pub(super) fn add(&mut self, shape: &Shape, place: DAffine3, material: u32) {
        let model = &mut self.model;
        let first = model.vertices.len() as u32;
        let moved = |corner: &Corner| place.transform_point3(corner.position).as_vec3().to_array();
        model.vertices.extend(shape.corners.iter().map(moved));
        for triangle in &shape.triangles {
            let corners = triangle.map(|index| &shape.corners[index as usize]);
            model.triangles.push(triangle.map(|index| first + index));
            model.normals.push(corners.map(|corner| {
                place.transform_vector3(corner.normal).normalize().as_vec3().to_array()
            }));
            model.uvs.push(corners.map(|corner| corner.uv.map(|x| x as f32)));
            model.material_ids.push(material);
        }
    }
}

impl Shape {
    /// Adds the quadrilateral a, b, c, d as two triangles.
    pub(super) fn quad(&mut self, [a, b, c, d]: [u32; 4]) {
        self.triangles.extend([[a, b, c], [a, c, d]]);
    }

    /// A flat quadrilateral with corners of its own and texture coordinates in world units.
    pub(super) fn flat_quad(&mut self, positions: [DVec3; 4], uvs: [[f64; 2]; 4]) {
        let first = self.corners.len() as u32;
        let normal = (positions[1] - positions[0]).cross(positions[2] - positions[0]);
        for (position, uv) in positions.into_iter().zip(uvs) {
            self.corners.push(Corner { position, normal, uv });
        }
        self.quad([0, 1, 2, 3].map(|i| first + i));
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use std::collections::HashMap;

    /// Asserts that each edge, known by its ends' positions, is passed once in each direction, and
    /// that every normal points to the front of its triangle.
    pub(in crate::built_in) fn assert_closed(shape: &Shape) {
        let key = |index: u32| shape.corners[index as usize].position.to_array().map(f64::to_bits);
        let mut balance = HashMap::new();
        for &[a, b, c] in &shape.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *balance.entry((key(from), key(to))).or_insert(0) += 1;
                *balance.entry((key(to), key(from))).or_insert(0) -= 1;
            }
            let [a, b, c] = [a, b, c].map(|i| &shape.corners[i as usize]);
            let front = (b.position - a.position).cross(c.position - a.position);
            assert!([a, b, c].iter().all(|corner| corner.normal.dot(front) > 0.0));
        }
        assert!(balance.values().all(|&count| count == 0));
    }
}
