//! Rays that go on from a surface: mirrored and refracted.

use super::dielectric::Boundary;
use super::tracer::{NEGLIGIBLE, Path, Tracer};
use crate::surface::Surface;
use glam::{DVec3, Vec3};

/// What the random numbers of a bounce are for.
const MIRROR: u32 = 2;
const REFRACTION: u32 = 3;

impl Tracer<'_> {
    /// What a perfect mirror brings, in the share `mirror`.
    pub(super) fn mirrored(&mut self, surface: &Surface<'_>, mirror: Vec3, path: &Path) -> Vec3 {
        let direction = 2.0 * surface.viewer.dot(surface.normal) * surface.normal - surface.viewer;
        self.bounce(surface, direction, mirror, &path.bounced(MIRROR, mirror, true))
    }

    /// What the boundary of a clear body mirrors and lets through.
    pub(super) fn glass(&mut self, surface: &Surface<'_>, transmission: f32, path: &Path) -> Vec3 {
        let ior = f64::from(surface.material.ior.max(1e-3));
        let eta = if surface.outside { ior } else { 1.0 / ior };
        let boundary = Boundary::new(surface.viewer, surface.normal, eta);
        let reflectance = boundary.reflectance as f32;
        let mirrored = Vec3::splat(transmission * reflectance);
        let mut light = self.bounce(
            surface,
            boundary.reflected,
            mirrored,
            &path.bounced(MIRROR, mirrored, true),
        );
        if let Some(direction) = boundary.refracted {
            let passed = surface.base_color * transmission * (1.0 - reflectance);
            let path = path.bounced(REFRACTION, passed, true);
            light += self.pass(surface, direction, passed, &path);
        }
        light
    }

    /// `weight` times what comes from `direction` on the viewer's side of the surface.
    pub(super) fn bounce(
        &mut self,
        surface: &Surface<'_>,
        direction: DVec3,
        weight: Vec3,
        path: &Path,
    ) -> Vec3 {
        self.follow(surface, kept_on_side(direction, surface.at.facing), weight, path)
    }

    /// `weight` times what comes from `direction` behind the surface.
    fn pass(&mut self, surface: &Surface<'_>, direction: DVec3, weight: Vec3, path: &Path) -> Vec3 {
        self.follow(surface, kept_on_side(direction, -surface.at.facing), weight, path)
    }

    fn follow(
        &mut self,
        surface: &Surface<'_>,
        direction: DVec3,
        weight: Vec3,
        path: &Path,
    ) -> Vec3 {
        if path.weight < NEGLIGIBLE {
            return Vec3::ZERO;
        }
        if path.bounces > self.options.max_bounces {
            return weight * Vec3::from(self.options.ambient);
        }
        weight * self.radiance(&surface.at.ray_along(direction), path)
    }
}

/// `direction`, or if a smooth normal has led it to the wrong side of the triangle, the direction
/// nearest to it that is just on the side that `facing` points to.
fn kept_on_side(direction: DVec3, facing: DVec3) -> DVec3 {
    const JUST: f64 = 1e-3;
    let height = direction.dot(facing);
    if height >= JUST {
        return direction.normalize();
    }
    (direction + (JUST - height) * facing).normalize_or(facing)
}
