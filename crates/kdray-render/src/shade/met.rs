//! What a ray meets next: a surface, or a lamp before it.

use super::dielectric::attenuation;
use super::tracer::{Path, Tracer};
use crate::light::Lamp;
use crate::surface::{Surface, opacity};
use glam::Vec3;
use kdray::{Hit, Ray};

/// What a ray meets next.
pub(super) enum Met<'a> {
    /// A lamp of that radiance, behind which nothing is seen.
    Lamp(Vec3),
    /// A surface, and the share of the light from there that is left where the ray comes from.
    Surface { surface: Surface<'a>, left: Vec3 },
}

impl<'a> Tracer<'a> {
    /// What the ray meets from `t_before` on, if its next hit is `hit`.
    pub(super) fn meet(&self, ray: &Ray, t_before: f64, hit: &Hit, path: &Path) -> Met<'a> {
        if let Some(glow) = self.seen_lamp(ray, [t_before, hit.t], path) {
            return Met::Lamp(glow);
        }
        let surface = Surface::new(self.world, ray, hit);
        // Where a surface is cut out there is no body.
        let is_there = surface.opacity > 0.0;
        let left = if is_there { left_before(&surface, hit.t - t_before) } else { Vec3::ONE };
        Met::Surface { surface, left }
    }

    /// Whether the ray goes on behind a hit, because the surface is a cut-out or a veil there.
    pub(super) fn goes_on_behind(&self, hit: &Hit) -> bool {
        opacity(self.world, hit) < 1.0
    }

    /// The radiance of a lamp's surface that the ray meets between two places.
    pub(super) fn seen_lamp(&self, ray: &Ray, [from, to]: [f64; 2], path: &Path) -> Option<Vec3> {
        if !path.sees_lamps {
            return None;
        }
        let seen = |lamp: &Lamp| lamp.seen(ray.origin.into(), ray.direction.into());
        let between = |&(t, _): &(f64, Vec3)| from < t && t < to;
        let nearest = |a: &(f64, Vec3), b: &(f64, Vec3)| a.0.total_cmp(&b.0);
        self.lamps.iter().filter_map(seen).filter(between).min_by(nearest).map(|(_, glow)| glow)
    }
}

/// What is left of a surface's light after a `distance` on its inner side.
fn left_before(surface: &Surface<'_>, distance: f64) -> Vec3 {
    if surface.outside { Vec3::ONE } else { attenuation(surface.material, distance) }
}
