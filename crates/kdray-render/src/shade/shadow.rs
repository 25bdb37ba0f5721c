//! Shadow rays.

use super::dielectric::{Boundary, attenuation};
use super::whitted::Tracer;
use crate::surface::{Surface, opacity};
use glam::{DVec3, Vec3};
use kdray::{Hit, Ray};
use kdray_scene::{AlphaMode, Material};

/// The end of a shadow ray to a light at t = 1: short of it by 2^-32 of the distance, so that a
/// lamp in the plane of a ceiling is not hidden by the ceiling.
pub(crate) const SHORT_OF_LIGHT: f64 = 1.0 - 1.0 / (1u64 << 32) as f64;

impl Tracer<'_> {
    /// The share of light that comes through along `ray`, within its interval. Opaque surfaces
    /// let nothing through, blended ones 1 − opacity; clear bodies let light pass straight on, as
    /// if it were not bent, less what they mirror and absorb.
    pub(crate) fn transmittance(&self, ray: &Ray) -> Vec3 {
        self.count_ray();
        match self.world.scene().occluder(ray) {
            None => Vec3::ONE,
            Some(hit) if is_opaque(self.world.material(hit.primitive_id)) => Vec3::ZERO,
            Some(_) => self.filtered(ray),
        }
    }

    /// The same through every surface that the ray crosses.
    fn filtered(&self, ray: &Ray) -> Vec3 {
        let length = DVec3::from(ray.direction).length();
        let mut left = Vec3::ONE;
        let mut t_before = ray.interval.t_min;
        for hit in self.world.scene().all_hits(ray) {
            left *= self.passed(ray, &hit, (hit.t - t_before) * length);
            if left.max_element() <= 0.0 {
                return Vec3::ZERO;
            }
            t_before = hit.t;
        }
        left
    }

    /// What one surface lets through, and what is left of light in the body before it, if that is
    /// where the ray comes from.
    fn passed(&self, ray: &Ray, hit: &Hit, distance: f64) -> Vec3 {
        let material = self.world.material(hit.primitive_id);
        if is_opaque(material) {
            return Vec3::ZERO;
        }
        let opacity = opacity(self.world, hit);
        if material.transmission == 0.0 || opacity == 0.0 {
            return Vec3::splat(1.0 - opacity);
        }
        let surface = Surface::new(self.world, ray, hit);
        // The reflectance of both sides is that of the outer one, as along the unbent ray.
        let eta = f64::from(material.ior.max(1.0));
        let mirrored = Boundary::new(surface.viewer, surface.normal, eta).reflectance as f32;
        let mut through = surface.base_color * material.transmission * (1.0 - mirrored);
        if !surface.outside {
            through *= attenuation(material, distance);
        }
        through * opacity + Vec3::splat(1.0 - opacity)
    }
}

/// Whether no light passes, whatever the textures say.
fn is_opaque(material: &Material) -> bool {
    material.transmission == 0.0 && material.alpha_mode == AlphaMode::Opaque
}
