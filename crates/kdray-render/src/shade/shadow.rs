//! Shadow rays.

use super::dielectric::{Boundary, attenuation};
use crate::surface::{Surface, opacity};
use crate::world::{World, is_opaque};
use glam::{DVec3, Vec3};
use kdray::{Hit, Ray};

/// The end of a shadow ray to a light at t = 1: short of it by 2^-32 of the distance, so that a
/// lamp in the plane of a ceiling is not hidden by the ceiling.
pub(crate) const SHORT_OF_LIGHT: f64 = 1.0 - 1.0 / (1u64 << 32) as f64;

/// Gives `found` the index of each ray and the share of light that comes through along it, within
/// its interval. Opaque surfaces let nothing through, blended ones 1 − opacity; clear bodies let
/// light pass straight on, as if it were not bent, less what they mirror and absorb.
pub(super) fn transmittances(world: &World, rays: &[Ray], mut found: impl FnMut(usize, Vec3)) {
    let scene = world.scene();
    let each = rays;
    if world.lets_light_through() {
        scene.each_closest_hit(each, |index, first| {
            found(index, first.map_or(Vec3::ONE, |hit| past(world, &rays[index], &hit)));
        });
    } else {
        scene.each_any_hit(each, |index, is_hit| {
            found(index, if is_hit { Vec3::ZERO } else { Vec3::ONE });
        });
    }
}

/// The share that comes through along a ray whose closest hit is `first`.
fn past(world: &World, ray: &Ray, first: &Hit) -> Vec3 {
    if is_opaque(world.material(first.primitive_id)) {
        return Vec3::ZERO;
    }
    let length = DVec3::from(ray.direction).length();
    let mut left = Vec3::ONE;
    let mut t_before = ray.interval.t_min;
    // All that the ray crosses from there, since another surface may lie at the very same t.
    for hit in world.scene().all_hits(&ray.with_interval(first.t, ray.interval.t_max)) {
        left *= passed(world, ray, &hit, (hit.t - t_before) * length);
        if left.max_element() <= 0.0 {
            return Vec3::ZERO;
        }
        t_before = hit.t;
    }
    left
}

/// What one surface lets through, and what is left of light in the body before it, if that is
/// where the ray comes from.
fn passed(world: &World, ray: &Ray, hit: &Hit, distance: f64) -> Vec3 {
    let material = world.material(hit.primitive_id);
    if is_opaque(material) {
        return Vec3::ZERO;
    }
    let opacity = opacity(world, hit);
    if material.transmission == 0.0 || opacity == 0.0 {
        return Vec3::splat(1.0 - opacity);
    }
    let surface = Surface::new(world, ray, hit);
    // The reflectance of both sides is that of the outer one, as along the unbent ray.
    let eta = f64::from(material.ior.max(1.0));
    let mirrored = Boundary::new(surface.viewer, surface.normal, eta).reflectance as f32;
    let mut through = surface.base_color * material.transmission * (1.0 - mirrored);
    if !surface.outside {
        through *= attenuation(material, distance);
    }
    through * opacity + Vec3::splat(1.0 - opacity)
}
