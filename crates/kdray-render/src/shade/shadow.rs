//! Shadow rays.

use super::dielectric::{Boundary, attenuation};
use crate::bundle::Bundle;
use crate::surface::{Surface, opacity};
use crate::world::{World, is_opaque};
use glam::{DVec3, Vec3};
use kdray::geometry::Common;
use kdray::{Hit, Ray};

/// The end of a shadow ray to a light at t = 1: short of it by 2^-32 of the distance, so that a
/// lamp in the plane of a ceiling is not hidden by the ceiling.
pub(crate) const SHORT_OF_LIGHT: f64 = 1.0 - 1.0 / (1u64 << 32) as f64;

/// Writes to `through` the share of light that comes through along each of the rays at `places`, within
/// its interval. Opaque surfaces let nothing through, blended ones 1 − opacity; clear bodies let
/// light pass straight on, as if it were not bent, less what they mirror and absorb.
pub(super) fn in_batch(world: &World, rays: &[Ray], places: &[usize], through: &mut [Vec3]) {
    let each = places.iter().map(|&place| &rays[place]);
    if world.lets_light_through() {
        world.scene().each_closest_hit(each, |index, first| {
            let place = places[index];
            through[place] = past(world, &rays[place], first);
        });
    } else {
        let mut found = |index: usize, is_hit| through[places[index]] = unless(is_hit);
        world.scene().each_any_hit(each, &mut found);
    }
}

/// The same as [`in_batch`], for rays that share `common` and their intervals.
pub(super) fn in_packets(
    world: &World,
    common: Common,
    bundle: &mut Bundle,
    rays: &[Ray],
    places: &[usize],
    through: &mut [Vec3],
) {
    let Some(&first) = places.first() else { return };
    let t_max = rays[first].interval.t_max;
    bundle.fill(common, places.iter().map(|&place| &rays[place]));
    if world.lets_light_through() {
        let (hits, _) = bundle.closest_hits(world.scene(), t_max);
        for (index, &place) in places.iter().enumerate() {
            through[place] = past(world, &rays[place], hits.get(index));
        }
    } else {
        let found = bundle.any_hits(world.scene(), t_max);
        places.iter().zip(found).for_each(|(&place, &is_hit)| through[place] = unless(is_hit));
    }
}

/// All light, unless something is in its way.
fn unless(is_hit: bool) -> Vec3 {
    if is_hit { Vec3::ZERO } else { Vec3::ONE }
}

/// The share that comes through along a ray whose closest hit is `first`.
fn past(world: &World, ray: &Ray, first: Option<Hit>) -> Vec3 {
    let Some(first) = first else { return Vec3::ONE };
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
