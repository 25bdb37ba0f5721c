//! What a surface looks like.

/// A surface, in the words of glTF 2.0's metallic-roughness model and of Whitted's (1980) mirror
/// and glass. Colours are linear RGB.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Its name in the file, if any.
    pub name: String,
    /// The colour of diffuse reflection, or of a metal's specular reflection.
    pub base_color: [f32; 3],
    /// Multiplies `base_color`, and its alpha `opacity`.
    pub base_color_texture: Option<TextureRef>,
    /// 0 for dielectrics, 1 for metals.
    pub metallic: f32,
    /// 0 for a smooth surface, 1 for a matt one: the width of the highlight.
    pub roughness: f32,
    /// Multiplies `roughness` (green) and `metallic` (blue).
    pub metallic_roughness_texture: Option<TextureRef>,
    /// The share of light, at normal incidence, that a smooth dielectric mirrors or highlights.
    pub specular: [f32; 3],
    /// The share of light that is mirrored perfectly, besides what Fresnel's equations give glass.
    pub mirror: [f32; 3],
    /// The share of light that enters the body: 1 for clear glass.
    pub transmission: f32,
    /// The index of refraction of the body.
    pub ior: f32,
    /// What white light becomes after `attenuation_distance` in the body (Beer and Lambert).
    pub attenuation_color: [f32; 3],
    /// See `attenuation_color`; infinite for a clear body.
    pub attenuation_distance: f32,
    /// Emitted radiance.
    pub emission: [f32; 3],
    /// Multiplies `emission`.
    pub emission_texture: Option<TextureRef>,
    /// 1 for opaque surfaces; used as `alpha_mode` says.
    pub opacity: f32,
    /// What `opacity` means.
    pub alpha_mode: AlphaMode,
    /// Shown in its colour alone, without light or shadow.
    pub unlit: bool,
}

/// What a surface's opacity means.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum AlphaMode {
    /// Nothing: the surface is opaque.
    #[default]
    Opaque,
    /// The surface is there where the opacity is at least this, and not there elsewhere.
    Mask(f32),
    /// The surface lets 1 − opacity of the light straight through.
    Blend,
}

/// A texture as a material uses it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureRef {
    /// The index in [`Model::textures`](crate::Model::textures).
    pub texture: usize,
    /// Rows of the 2x3 matrix that texture coordinates (u, v, 1) are multiplied with first.
    pub transform: [[f32; 3]; 2],
}

/// An image in linear RGBA, the upper row first.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// `width · height` pixels; sRGB colours have been made linear.
    pub pixels: Vec<[f32; 4]>,
    /// What lies beyond the image, in u and v.
    pub wrap: [Wrap; 2],
}

/// What lies beyond the edge of a texture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// The image again.
    #[default]
    Repeat,
    /// The image mirrored.
    Mirror,
    /// The pixels of the edge.
    Clamp,
}

impl TextureRef {
    /// The transform that changes nothing.
    pub const IDENTITY: [[f32; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
}

impl Default for Material {
    fn default() -> Self {
        Self {
            name: String::new(),
            base_color: [0.8; 3],
            base_color_texture: None,
            metallic: 0.0,
            roughness: 0.6,
            metallic_roughness_texture: None,
            specular: [0.04; 3],
            mirror: [0.0; 3],
            transmission: 0.0,
            ior: 1.5,
            attenuation_color: [1.0; 3],
            attenuation_distance: f32::INFINITY,
            emission: [0.0; 3],
            emission_texture: None,
            opacity: 1.0,
            alpha_mode: AlphaMode::Opaque,
            unlit: false,
        }
    }
}
