//! What the statements about a material mean for the renderer.

use super::maps::Maps;
use super::mtl::Statements;
use crate::cut::cut;
use crate::mesh::MeshBuilder;
use crate::{AlphaMode, Material};

/// Statements in the words of the renderer.
pub(super) fn material(
    statements: &Statements,
    maps: &mut Maps<'_>,
    builder: &mut MeshBuilder<'_>,
) -> Material {
    let plain = Material::default();
    let roughness = statements.roughness.or(statements.shininess.map(roughness)).unwrap_or(0.6);
    let mut material = Material {
        name: statements.name.clone(),
        base_color: statements.diffuse.map_or(plain.base_color, unit),
        metallic: statements.metallic.unwrap_or(0.0).clamp(0.0, 1.0),
        roughness: roughness.clamp(0.0, 1.0),
        specular: statements.specular.map_or(plain.specular, unit),
        emission: statements.emission.unwrap_or_default().map(|x| x.max(0.0)),
        ior: statements.ior.filter(|&ior| ior >= 1.0).unwrap_or(plain.ior),
        ..plain
    };
    set_illumination(&mut material, statements);
    if material.transmission == 0.0 {
        set_opacity(&mut material, statements, builder);
    }
    set_maps(&mut material, statements, maps, builder);
    material
}

fn unit(color: [f32; 3]) -> [f32; 3] {
    color.map(|x| x.clamp(0.0, 1.0))
}

fn set_illumination(material: &mut Material, statements: &Statements) {
    match statements.illumination.unwrap_or(2.0) as i32 {
        // Colour or diffuse light alone.
        0 | 1 => material.specular = [0.0; 3],
        // Ray-traced mirrors.
        3 | 5 => material.mirror = material.specular,
        // Glass: its colour is the hue of the filter, for the amount means different things to
        // different programs.
        4 | 6 | 7 => {
            material.transmission = 1.0;
            material.base_color = statements.filter.map_or([1.0; 3], hue);
        }
        _ => {}
    }
}

fn set_maps(
    material: &mut Material,
    statements: &Statements,
    maps: &mut Maps<'_>,
    builder: &mut MeshBuilder<'_>,
) {
    if let Some(map) = &statements.diffuse_map {
        material.base_color_texture = maps.texture(map, builder);
        // Programs that write a map often leave its factor black.
        if material.base_color_texture.is_some() && material.base_color == [0.0; 3] {
            material.base_color = [1.0; 3];
        }
    }
    if let Some(map) = &statements.emission_map {
        material.emission_texture = maps.texture(map, builder);
        if material.emission_texture.is_some() && statements.emission.is_none() {
            material.emission = [1.0; 3];
        }
    }
}

/// `d` is opacity, `Tr` is 1 − `d`; but old versions of MeshLab wrote `Tr 1` for opaque surfaces,
/// and nobody describes invisible ones.
fn set_opacity(material: &mut Material, statements: &Statements, builder: &mut MeshBuilder<'_>) {
    let from_tr = statements.transparency.map(|tr| 1.0 - tr);
    let opacity = match (statements.dissolve, from_tr) {
        (None, Some(opacity)) if opacity <= 0.0 => {
            let name = cut(&material.name);
            let warning = format!("material {name:?}: `Tr 1` without `d` taken as opaque");
            builder.warn_often("materials with `Tr 1` without `d` taken as opaque", warning);
            1.0
        }
        (dissolve, from_tr) => dissolve.or(from_tr).unwrap_or(1.0).clamp(0.0, 1.0),
    };
    material.opacity = opacity;
    if opacity < 1.0 {
        material.alpha_mode = AlphaMode::Blend;
    }
}

/// The roughness with which a highlight is as wide as with this Phong exponent: α² = 2 / (n + 2)
/// (Walter et al. 2007, section 5.2) with α = roughness².
fn roughness(exponent: f32) -> f32 {
    (2.0 / (exponent.max(0.0) + 2.0)).powf(0.25)
}

/// The colour with its largest channel at 1.
fn hue(color: [f32; 3]) -> [f32; 3] {
    let largest = color.into_iter().fold(0.0, f32::max);
    if largest > 0.0 { color.map(|x| (x / largest).clamp(0.0, 1.0)) } else { [1.0; 3] }
}
