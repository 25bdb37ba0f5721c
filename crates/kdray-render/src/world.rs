//! A model that rays can be shot at.

use crate::fingerprint;
use kdray::{Aabb, BuildError, BuildOptions, BuildProgress, MeshError, Scene, TriangleMesh};
use kdray_scene::{AlphaMode, Material, Model, TextureRef};
use std::ops::ControlFlow;
use std::sync::OnceLock;
use thiserror::Error;

/// A model and the kd-tree over its triangles.
#[derive(Clone, Debug)]
pub struct World {
    model: Model,
    scene: Scene,
    /// What triangles look like that have no material.
    default_material: Material,
    lets_light_through: bool,
    fingerprint: OnceLock<u64>,
}

/// Why a model cannot be rendered.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum WorldError {
    /// The mesh is refused.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The tree could not be built.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// A per-triangle list is neither empty nor as long as the list of triangles.
    #[error("the model has {triangles} triangles, but {found} {list}; give one for each, or none")]
    Length {
        /// Which list.
        list: &'static str,
        /// Its length.
        found: usize,
        /// How many triangles there are.
        triangles: usize,
    },
    /// A triangle names a material that is not there.
    #[error(
        "triangle {triangle} uses material {material}, but there are only {materials}; add the missing ones, or choose another"
    )]
    NoSuchMaterial {
        /// The index of the triangle.
        triangle: usize,
        /// The material index it holds.
        material: u32,
        /// How many materials there are.
        materials: usize,
    },
    /// A material names a texture that is not there.
    #[error(
        "material {material} uses texture {texture}, but there are only {textures}; add the missing ones, or choose another"
    )]
    NoSuchTexture {
        /// The index of the material.
        material: usize,
        /// The texture index it holds.
        texture: usize,
        /// How many textures there are.
        textures: usize,
    },
    /// A texture has no pixels, or not as many as its size says.
    #[error(
        "texture {texture} is {width} x {height}, but holds {pixels} pixels; give width times height, and at least one"
    )]
    TextureSize {
        /// The index of the texture.
        texture: usize,
        /// Its width.
        width: usize,
        /// Its height.
        height: usize,
        /// How many pixels it holds.
        pixels: usize,
    },
}

impl World {
    /// Builds the tree over the model's triangles.
    ///
    /// # Errors
    /// What in the model contradicts itself, or why there is no tree.
    pub fn new(model: Model, options: &BuildOptions) -> Result<Self, WorldError> {
        Self::new_with_progress(model, options, &|_| ControlFlow::Continue(()))
    }

    /// Builds the tree over the model's triangles, tells `progress` how far it is, and stops if
    /// that answers [`ControlFlow::Break`].
    ///
    /// # Errors
    /// What in the model contradicts itself, or why there is no tree.
    pub fn new_with_progress(
        mut model: Model,
        options: &BuildOptions,
        progress: &(dyn Fn(BuildProgress) -> ControlFlow<()> + Sync),
    ) -> Result<Self, WorldError> {
        check(&model, model.triangles.len())?;
        let vertices = std::mem::take(&mut model.vertices);
        let triangles = std::mem::take(&mut model.triangles);
        let mesh = TriangleMesh::new(vertices, triangles)?;
        let scene = Scene::build_with_progress(mesh, options, progress)?;
        Ok(Self::of_parts(model, scene))
    }

    /// Takes triangles with the tree over them as they are; `model` tells what they look like. Its own
    /// `vertices` and `triangles` are not looked at.
    ///
    /// ```
    /// use kdray::{Scene, TriangleMesh};
    /// use kdray_render::World;
    /// use kdray_scene::Model;
    /// let corners = vec![[0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]];
    /// let scene = Scene::build(TriangleMesh::new(corners, vec![[0, 1, 2]])?, &Default::default())?;
    /// let grey = World::of_scene(Model::default(), scene.clone())?;
    /// assert_eq!(grey.scene().mesh(), scene.mesh());
    /// let two_ids = Model { material_ids: vec![0, 0], ..Model::default() };
    /// assert!(World::of_scene(two_ids, scene).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// What in the model contradicts itself, or the triangles.
    pub fn of_scene(model: Model, scene: Scene) -> Result<Self, WorldError> {
        check(&model, scene.mesh().triangles().len())?;
        Ok(Self::of_parts(model, scene))
    }

    fn of_parts(model: Model, scene: Scene) -> Self {
        let lets_light_through = lets_light_through(&model);
        let (default_material, fingerprint) = (Material::default(), OnceLock::new());
        Self { model, scene, default_material, lets_light_through, fingerprint }
    }

    /// The triangles with the tree over them.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The model, whose `vertices` and `triangles` have moved to
    /// [`scene().mesh()`](Scene::mesh).
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The box that holds all triangles; empty if there are none.
    pub fn bounds(&self) -> &Aabb<3> {
        self.scene.tree().bounds()
    }

    /// A hash of all that rays can meet.
    pub(crate) fn fingerprint(&self) -> u64 {
        let hash = || fingerprint::of_model(self.scene.mesh(), &self.model);
        *self.fingerprint.get_or_init(hash)
    }

    /// Whether light passes some of the triangles; where it does not, any hit ends a shadow ray.
    pub(crate) fn lets_light_through(&self) -> bool {
        self.lets_light_through
    }

    /// What a triangle looks like.
    pub fn material(&self, triangle: u32) -> &Material {
        let id = self.model.material_ids.get(triangle as usize);
        id.and_then(|&id| self.model.materials.get(id as usize)).unwrap_or(&self.default_material)
    }
}

/// Whether no light passes, whatever the textures say.
pub(crate) fn is_opaque(material: &Material) -> bool {
    material.transmission == 0.0 && material.alpha_mode == AlphaMode::Opaque
}

/// Whether some triangle has a material that light passes.
fn lets_light_through(model: &Model) -> bool {
    let passes: Vec<bool> = model.materials.iter().map(|it| !is_opaque(it)).collect();
    model.material_ids.iter().any(|&id| passes[id as usize])
}

fn check(model: &Model, triangles: usize) -> Result<(), WorldError> {
    for (list, found) in [
        ("normals", model.normals.len()),
        ("texture coordinates", model.uvs.len()),
        ("colors", model.colors.len()),
        ("material ids", model.material_ids.len()),
    ] {
        if found != 0 && found != triangles {
            return Err(WorldError::Length { list, found, triangles });
        }
    }
    check_materials(model)?;
    for (texture, image) in model.textures.iter().enumerate() {
        let (width, height, pixels) = (image.width, image.height, image.pixels.len());
        if pixels == 0 || width.checked_mul(height) != Some(pixels) {
            return Err(WorldError::TextureSize { texture, width, height, pixels });
        }
    }
    Ok(())
}

fn check_materials(model: &Model) -> Result<(), WorldError> {
    let materials = model.materials.len();
    for (triangle, &material) in model.material_ids.iter().enumerate() {
        if material as usize >= materials {
            return Err(WorldError::NoSuchMaterial { triangle, material, materials });
        }
    }
    let textures = model.textures.len();
    for (material, m) in model.materials.iter().enumerate() {
        let used = [m.base_color_texture, m.metallic_roughness_texture, m.emission_texture];
        for TextureRef { texture, .. } in used.into_iter().flatten() {
            if texture >= textures {
                return Err(WorldError::NoSuchTexture { material, texture, textures });
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_materials_in_use_let_light_through() {
        let glass = Material { transmission: 1.0, ..Material::default() };
        let veil = Material { alpha_mode: AlphaMode::Blend, ..Material::default() };
        let with_ids = |material_ids: &[u32]| Model {
            materials: vec![Material::default(), glass.clone(), veil.clone()],
            material_ids: material_ids.to_vec(),
            ..Model::default()
        };
        let cases: [(&[u32], bool); 4] =
            [(&[], false), (&[0, 0], false), (&[0, 1], true), (&[2], true)];
        for (ids, expected) in cases {
            assert_eq!(lets_light_through(&with_ids(ids)), expected, "{ids:?}");
        }
    }
}
