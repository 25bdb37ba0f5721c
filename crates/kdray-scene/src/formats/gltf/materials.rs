//! Materials.

use super::Document;
use super::buffers::Buffers;
use super::textures::Textures;
use crate::mesh::MeshBuilder;
use crate::textures::Encoding;
use crate::{AlphaMode, LoadError, Material, TextureRef};
use ::gltf::json;
use ::gltf::json::texture::Info;
use ::gltf::json::validation::Checked;

/// What meshes need to know of the materials that the model now has.
pub(super) struct ReadMaterials {
    uv_sets: Vec<u32>,
}

impl ReadMaterials {
    /// Which set of texture coordinates a material uses.
    pub(super) fn uv_set(&self, material: usize) -> u32 {
        self.uv_sets.get(material).copied().unwrap_or(0)
    }
}

/// Reads materials.
pub(super) struct Materials<'a> {
    document: Document<'a>,
    textures: Textures<'a>,
}

impl<'a> Materials<'a> {
    pub(super) fn new(document: Document<'a>, buffers: &'a Buffers) -> Self {
        Self { document, textures: Textures::new(document, buffers) }
    }

    /// Adds all materials to the model.
    pub(super) fn read(
        mut self,
        builder: &mut MeshBuilder<'_>,
    ) -> Result<ReadMaterials, LoadError> {
        let mut uv_sets = Vec::new();
        for (index, json) in self.document.root.materials.iter().enumerate() {
            let (material, uv_set) = self.material(index, json, builder);
            builder.model.materials.push(material);
            uv_sets.push(uv_set);
        }
        Ok(ReadMaterials { uv_sets })
    }

    fn material(
        &mut self,
        index: usize,
        json: &json::Material,
        builder: &mut MeshBuilder<'_>,
    ) -> (Material, u32) {
        let surface = &json.pbr_metallic_roughness;
        let infos = [
            (surface.base_color_texture.as_ref(), Encoding::Srgb),
            (surface.metallic_roughness_texture.as_ref(), Encoding::Linear),
            (json.emissive_texture.as_ref(), Encoding::Srgb),
        ];
        // A model has one set of texture coordinates: that of the first texture.
        let uv_set = infos.iter().find_map(|(info, _)| info.map(uv_set_of)).unwrap_or(0);
        let [base_color_texture, metallic_roughness_texture, emission_texture] =
            infos.map(|(info, encoding)| {
                let info = info?;
                if uv_set_of(info) != uv_set {
                    let set = uv_set_of(info);
                    let warning = format!(
                        "materials[{index}]: a texture on the second set of coordinates in use, \
                         TEXCOORD_{set}, left out"
                    );
                    builder.warn_often("textures on a second set of coordinates left out", warning);
                    return None;
                }
                let texture = self.textures.index(info.index.value(), encoding, builder)?;
                Some(TextureRef { texture, transform: texture_transform(info) })
            });
        let [r, g, b, opacity] = surface.base_color_factor.0;
        let mut material = Material {
            name: json.name.clone().unwrap_or_default(),
            base_color: [r, g, b].map(|x| x.clamp(0.0, 1.0)),
            base_color_texture,
            metallic: surface.metallic_factor.0.clamp(0.0, 1.0),
            roughness: surface.roughness_factor.0.clamp(0.0, 1.0),
            metallic_roughness_texture,
            emission: json.emissive_factor.0.map(|x| x.max(0.0)),
            emission_texture,
            opacity: opacity.clamp(0.0, 1.0),
            alpha_mode: alpha_mode(json),
            ..Material::default()
        };
        if let Some(extensions) = &json.extensions {
            apply_extensions(&mut material, extensions);
        }
        (material, uv_set)
    }
}

fn uv_set_of(info: &Info) -> u32 {
    let transform = info.extensions.as_ref().and_then(|known| known.texture_transform.as_ref());
    transform.and_then(|transform| transform.tex_coord).unwrap_or(info.tex_coord)
}

/// `KHR_texture_transform`: translation · rotation · scale.
fn texture_transform(info: &Info) -> [[f32; 3]; 2] {
    let transform = info.extensions.as_ref().and_then(|known| known.texture_transform.as_ref());
    let Some(transform) = transform else { return TextureRef::IDENTITY };
    let (sin, cos) = transform.rotation.0.sin_cos();
    let ([su, sv], [ou, ov]) = (transform.scale.0, transform.offset.0);
    [[cos * su, sin * sv, ou], [-sin * su, cos * sv, ov]]
}

fn alpha_mode(json: &json::Material) -> AlphaMode {
    match json.alpha_mode {
        Checked::Valid(json::material::AlphaMode::Mask) => {
            AlphaMode::Mask(json.alpha_cutoff.unwrap_or_default().0)
        }
        Checked::Valid(json::material::AlphaMode::Blend) => AlphaMode::Blend,
        _ => AlphaMode::Opaque,
    }
}

fn apply_extensions(material: &mut Material, known: &json::extensions::material::Material) {
    material.unlit = known.unlit.is_some();
    if let Some(ior) = &known.ior {
        // 0 stands for "infinite" in the extension; below 1 means nothing.
        material.ior = if ior.ior.0 >= 1.0 { ior.ior.0 } else { material.ior };
    }
    // Fresnel's equations at normal incidence.
    let normal = ((material.ior - 1.0) / (material.ior + 1.0)).powi(2);
    material.specular = [normal; 3];
    if let Some(specular) = &known.specular {
        let color = specular.specular_color_factor.0;
        let factor = specular.specular_factor.0.clamp(0.0, 1.0);
        material.specular = color.map(|x| (x.max(0.0) * normal).min(1.0) * factor);
    }
    if let Some(transmission) = &known.transmission {
        material.transmission = transmission.transmission_factor.0.clamp(0.0, 1.0);
    }
    // A surface without thickness has no inside that could absorb light.
    if let Some(volume) = known.volume.as_ref().filter(|volume| volume.thickness_factor.0 > 0.0) {
        material.attenuation_color = volume.attenuation_color.0.map(|x| x.clamp(0.0, 1.0));
        let distance = volume.attenuation_distance.0;
        material.attenuation_distance = if distance > 0.0 { distance } else { f32::INFINITY };
    }
    if let Some(strength) = &known.emissive_strength {
        let strength = strength.emissive_strength.0.max(0.0);
        material.emission = material.emission.map(|channel| channel * strength);
    }
}
