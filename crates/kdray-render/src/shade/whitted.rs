//! Backward ray tracing: Whitted, "An Improved Illumination Model for Shaded Display" (1980).

use super::matt::Matt;
use super::met::Met;
use super::tracer::{NEGLIGIBLE, Path, Tracer};
use crate::surface::Surface;
use glam::Vec3;
use kdray::{Hit, Ray};

impl Tracer<'_> {
    /// The radiance that comes back along `ray`, whose direction has unit length.
    pub(super) fn radiance(&mut self, ray: &Ray, path: &Path) -> Vec3 {
        self.count_rays(1);
        let hit = self.world.scene().closest_hit(ray);
        self.radiance_from(hit.as_ref(), ray, path)
    }

    /// The radiance that comes back along `ray` from its closest hit and from behind that.
    pub(super) fn radiance_from(&mut self, hit: Option<&Hit>, ray: &Ray, path: &Path) -> Vec3 {
        match hit {
            // Behind a cut-out or a veil the ray goes on. All that it crosses is asked for, in
            // order, since another surface may lie at the very same t.
            Some(hit) if self.goes_on_behind(hit) => {
                let rest = ray.with_interval(hit.t, ray.interval.t_max);
                self.radiance_of(self.world.scene().all_hits(&rest), ray, path)
            }
            first => self.radiance_of(first.copied().into_iter(), ray, path),
        }
    }

    /// The radiance that comes back along `ray` from its `hits`, which are in order.
    fn radiance_of(&mut self, hits: impl Iterator<Item = Hit>, ray: &Ray, path: &Path) -> Vec3 {
        let (mut sum, mut through) = (Vec3::ZERO, Vec3::ONE);
        let mut t_before = ray.interval.t_min;
        for hit in hits {
            let (surface, left) = match self.meet(ray, t_before, &hit, path) {
                Met::Lamp(glow) => return sum + through * glow,
                Met::Surface { surface, left } => (surface, left),
            };
            through *= left;
            if surface.opacity > 0.0 {
                sum += through * surface.opacity * self.shade(&surface, path);
            }
            through *= 1.0 - surface.opacity;
            if through.max_element() * path.weight < NEGLIGIBLE {
                return sum;
            }
            t_before = hit.t;
        }
        let behind = self.seen_lamp(ray, [t_before, f64::INFINITY], path);
        let sky = || self.options.background.radiance(ray.direction.into());
        sum + through * behind.unwrap_or_else(sky)
    }

    /// The light that an opaque point of a surface sends to the viewer.
    fn shade(&mut self, surface: &Surface<'_>, path: &Path) -> Vec3 {
        let start = self.light_rays.len();
        let matt = self.gather(surface, path);
        self.answer(start);
        let light = self.light(surface, matt.as_ref(), path);
        self.light_rays.truncate(start);
        light
    }

    /// The matt part of a surface, if it has one, with its light rays pushed.
    pub(super) fn gather(&mut self, surface: &Surface<'_>, path: &Path) -> Option<Matt> {
        let share = matt_share(surface);
        let is_matt = !surface.material.unlit && share.max_element() > 0.0;
        is_matt.then(|| self.gather_matt(surface, share, path))
    }

    /// The light that an opaque point of a surface sends to the viewer: its emission, what its
    /// matt part reflects of lamps and ambient light, and what it mirrors and refracts. The light
    /// rays are answered.
    pub(super) fn light(
        &mut self,
        surface: &Surface<'_>,
        matt: Option<&Matt>,
        path: &Path,
    ) -> Vec3 {
        let material = surface.material;
        if material.unlit {
            return surface.base_color;
        }
        let mut light = surface.emission;
        if let Some(matt) = matt {
            light += self.matt(surface, matt, path);
        }
        let mirror = Vec3::from(material.mirror);
        if mirror.max_element() > 0.0 {
            light += self.mirrored(surface, mirror, path);
        }
        let transmission = transmission(surface);
        if transmission > 0.0 {
            light += self.glass(surface, transmission, path);
        }
        light
    }
}

/// The share of light that is let into a body.
fn transmission(surface: &Surface<'_>) -> f32 {
    surface.material.transmission * (1.0 - surface.metallic)
}

/// The share that is neither mirrored perfectly nor let through.
fn matt_share(surface: &Surface<'_>) -> Vec3 {
    let mirror = Vec3::from(surface.material.mirror);
    (Vec3::ONE - mirror).max(Vec3::ZERO) * (1.0 - transmission(surface))
}
