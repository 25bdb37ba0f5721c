//! A hit with all that shading needs.

use super::hit_point::HitPoint;
use super::texture;
use crate::world::World;
use glam::{DVec3, Vec3, Vec4};
use kdray::{Hit, Ray, Side};
use kdray_scene::{AlphaMode, Material};

/// The point of a surface that a ray has hit.
#[derive(Clone, Debug)]
pub(crate) struct Surface<'a> {
    pub(crate) material: &'a Material,
    /// Where the surface is, and which way it faces.
    pub(crate) at: HitPoint,
    /// The unit shading normal, on the same side of the surface and turned to the viewer.
    pub(crate) normal: DVec3,
    /// The unit vector to where the ray came from.
    pub(crate) viewer: DVec3,
    /// Whether the ray came from outside.
    pub(crate) outside: bool,
    /// The material's colour here, with texture and vertex colours.
    pub(crate) base_color: Vec3,
    pub(crate) metallic: f32,
    pub(crate) roughness: f32,
    /// How much of the surface is there, from 0 to 1.
    pub(crate) opacity: f32,
    pub(crate) emission: Vec3,
}

impl<'a> Surface<'a> {
    /// What `ray` found at `hit`.
    pub(crate) fn new(world: &'a World, ray: &Ray, hit: &Hit) -> Self {
        let at = HitPoint::new(world.scene().mesh(), ray, hit);
        let facing = at.facing;
        let viewer = -DVec3::from(ray.direction).normalize();
        let normal = shading_normal(world, hit).map_or(facing, |n| turned(n, facing, viewer));

        let material = world.material(hit.primitive_id);
        let uv = texture_coordinates(world, hit);
        let textures = &world.model().textures;
        let lookup = |reference: &Option<_>| {
            reference.as_ref().map_or(Vec4::ONE, |r| texture::sample(textures, r, uv))
        };
        let color = lookup(&material.base_color_texture);
        let metallic_roughness = lookup(&material.metallic_roughness_texture);
        Self {
            material,
            at,
            normal,
            viewer,
            outside: hit.side == Side::Front,
            base_color: Vec3::from(material.base_color) * color.truncate() * tint(world, hit),
            metallic: (material.metallic * metallic_roughness.z).clamp(0.0, 1.0),
            roughness: (material.roughness * metallic_roughness.y).clamp(0.0, 1.0),
            opacity: opacity(world, hit),
            emission: Vec3::from(material.emission) * lookup(&material.emission_texture).truncate(),
        }
    }
}

/// How much of the surface is there at `hit`, from 0 to 1.
pub(crate) fn opacity(world: &World, hit: &Hit) -> f32 {
    let material = world.material(hit.primitive_id);
    let alpha = || {
        let texture = material.base_color_texture.as_ref();
        let uv = || texture_coordinates(world, hit);
        let alpha = texture.map_or(1.0, |r| texture::sample(&world.model().textures, r, uv()).w);
        (material.opacity * alpha).clamp(0.0, 1.0)
    };
    match material.alpha_mode {
        AlphaMode::Opaque => 1.0,
        AlphaMode::Mask(cutoff) => f32::from(alpha() >= cutoff),
        AlphaMode::Blend => alpha(),
    }
}

fn weights(hit: &Hit) -> [f32; 3] {
    [1.0 - hit.u - hit.v, hit.u, hit.v].map(|w| w as f32)
}

fn shading_normal(world: &World, hit: &Hit) -> Option<DVec3> {
    let normals = world.model().normals.get(hit.primitive_id as usize)?;
    let [a, b, c] = normals.map(Vec3::from);
    let [wa, wb, wc] = weights(hit);
    (wa * a + wb * b + wc * c).as_dvec3().try_normalize()
}

/// The shading normal `n` on the side of the surface that `facing` is on; where it faces away from
/// the viewer, bent towards `facing` until the viewer is just in sight.
fn turned(n: DVec3, facing: DVec3, viewer: DVec3) -> DVec3 {
    const IN_SIGHT: f64 = 1e-3;
    let n = if n.dot(facing) < 0.0 { -n } else { n };
    let (seen, facing_seen) = (n.dot(viewer), facing.dot(viewer));
    if seen >= IN_SIGHT || facing_seen <= seen {
        return n;
    }
    let target = IN_SIGHT.min(facing_seen);
    let share = ((target - seen) / (facing_seen - seen)).clamp(0.0, 1.0);
    n.lerp(facing, share).normalize_or(facing)
}

fn texture_coordinates(world: &World, hit: &Hit) -> [f32; 2] {
    let Some(corners) = world.model().uvs.get(hit.primitive_id as usize) else { return [0.0; 2] };
    let w = weights(hit);
    [0, 1].map(|i| w[0] * corners[0][i] + w[1] * corners[1][i] + w[2] * corners[2][i])
}

fn tint(world: &World, hit: &Hit) -> Vec3 {
    let Some(colors) = world.model().colors.get(hit.primitive_id as usize) else {
        return Vec3::ONE;
    };
    let [a, b, c] = colors.map(Vec3::from);
    let [wa, wb, wc] = weights(hit);
    wa * a + wb * b + wc * c
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shading_normals_face_the_viewer_on_the_surface_side() {
        let facing = DVec3::Z;
        let viewer = DVec3::new(1.0, 0.0, 0.1).normalize();
        for n in [DVec3::new(-1.0, 0.0, 0.2), DVec3::new(0.3, 0.9, -0.5), DVec3::Z, DVec3::X] {
            let n = turned(n.normalize(), facing, viewer);
            assert!(
                n.dot(viewer) > 0.0 && n.dot(facing) >= 0.0 && (n.length() - 1.0).abs() < 1e-12
            );
        }
        let good = DVec3::new(0.1, 0.2, 0.9).normalize();
        assert_eq!(turned(good, facing, viewer), good);
        assert_eq!(turned(-good, facing, viewer), good);
    }
}
