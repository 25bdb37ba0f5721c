//! A flat scene: one list of triangles with all that is known of them.

use crate::{Camera, Light, Material, Texture};

/// Everything that a file or a generator describes, flattened to world space.
///
/// Per-triangle lists are either empty (nothing known) or as long as `triangles`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    /// Vertex positions; every one that a triangle uses is finite.
    pub vertices: Vec<[f32; 3]>,
    /// Three indices into `vertices` a triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Unit shading normals at the three corners of each triangle.
    pub normals: Vec<[[f32; 3]; 3]>,
    /// Texture coordinates at the three corners; (0, 0) is the image's *upper* left, as in glTF.
    pub uvs: Vec<[[f32; 2]; 3]>,
    /// Linear colours at the three corners, by which the material's base colour is multiplied.
    pub colors: Vec<[[f32; 3]; 3]>,
    /// The index of each triangle's material.
    pub material_ids: Vec<u32>,
    /// The materials; triangles without one look like [`Material::default`].
    pub materials: Vec<Material>,
    /// The images that materials refer to.
    pub textures: Vec<Texture>,
    /// The lights.
    pub lights: Vec<Light>,
    /// The cameras, the preferred one first.
    pub cameras: Vec<Camera>,
    /// What was passed over or mended while reading, a sentence each, for the user to see.
    /// Of those of a kind, such as missing textures, a hundred; one more counts the rest.
    pub warnings: Vec<String>,
}
