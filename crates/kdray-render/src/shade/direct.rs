//! Rays to the lamps and to the surroundings, and the light that comes along them.

use super::gloss::Gloss;
use super::light_rays::Toward;
use super::shadow::SHORT_OF_LIGHT;
use super::tracer::{Path, Tracer};
use crate::light::{Arrival, Lamp, Source};
use crate::sampling::{Sampler, cosine_hemisphere, tangents};
use crate::surface::Surface;
use glam::{DVec3, Vec3};
use kdray::Ray;
use std::f32::consts::PI;
use std::ops::Range;

/// What the random numbers of direct light are for.
const LAMPS: u32 = 0x100;
const OCCLUSION: u32 = 0x101;

/// Rays from a surface to its surroundings.
pub(crate) struct Surroundings {
    rays: Range<usize>,
    /// How many directions were tried: no rays go to those below the surface.
    count: u32,
}

impl Tracer<'_> {
    /// How many rays go to a lamp from what a ray sees after so many `bounces`.
    pub(crate) fn lamp_rays(&self, lamp: &Lamp, bounces: u32) -> u32 {
        // Soft shadows that are seen in a mirror need no more rays than the mirror has.
        if lamp.is_sharp() || bounces > 0 { 1 } else { self.options.light_samples }
    }

    /// Pushes rays to all lamps, with the light that the surface sends to the viewer for each, in
    /// its diffuse share `diffuse` and its highlight. Gives their places.
    pub(super) fn push_to_lamps(
        &mut self,
        surface: &Surface<'_>,
        diffuse: Vec3,
        gloss: &Gloss,
        path: &Path,
    ) -> Range<usize> {
        let start = self.light_rays.len();
        for (index, lamp) in self.lamps.iter().enumerate() {
            let count = self.lamp_rays(lamp, path.bounces);
            let sampler = path.sampler.fork(LAMPS).fork(index as u32);
            for i in 0..count {
                let arrival = lamp.arrival(surface.at.point.position(), sampler.point(i, count));
                if let Some((ray, light)) = self.reflected(surface, diffuse, gloss, &arrival) {
                    self.light_rays.push(ray, Toward::Lamp(index as u32), light, count);
                }
            }
        }
        start..self.light_rays.len()
    }

    /// The light that the surface sends to the viewer of what arrives from a lamp, and the ray
    /// that tells whether it does; `None` if it is not worth one.
    fn reflected(
        &self,
        surface: &Surface<'_>,
        diffuse: Vec3,
        gloss: &Gloss,
        arrival: &Arrival,
    ) -> Option<(Ray, Vec3)> {
        let to_light = match arrival.from {
            Source::Far(to_light) => to_light,
            Source::Point(position) => (position - surface.at.point.position()).normalize_or_zero(),
        };
        let cos = surface.normal.dot(to_light);
        let smoothed = terminator(surface, to_light);
        if cos <= 0.0 || smoothed <= 0.0 || arrival.irradiance.max_element() <= 0.0 {
            return None;
        }
        let reflected = (diffuse / PI * smoothed as f32 + gloss.value(to_light))
            * arrival.irradiance
            * cos as f32;
        // A light at the very point has infinite irradiance, and a NaN would spread.
        if !reflected.is_finite() || reflected.max_element() < self.negligible() {
            return None;
        }
        let ray = match arrival.from {
            Source::Far(to_light) => surface.at.ray_along(to_light),
            Source::Point(position) => {
                surface.at.ray_to(position).with_interval(0.0, SHORT_OF_LIGHT)
            }
        };
        Some((ray, reflected))
    }

    /// Pushes rays to the surroundings, spread as the cosine, up to the occlusion distance.
    pub(crate) fn push_to_surroundings(
        &mut self,
        surface: &Surface<'_>,
        count: u32,
        sampler: Sampler,
    ) -> Surroundings {
        let start = self.light_rays.len();
        let sampler = sampler.fork(OCCLUSION);
        let (x, y) = tangents(surface.normal);
        for i in 0..count {
            let local = cosine_hemisphere(sampler.point(i, count));
            let direction = x * local.x + y * local.y + surface.normal * local.z;
            if direction.dot(surface.at.facing) > 0.0 {
                let ray = surface.at.ray_along(direction);
                let ray = ray.with_interval(0.0, self.occlusion_distance);
                self.light_rays.push(ray, Toward::Surroundings, Vec3::ONE, 1);
            }
        }
        Surroundings { rays: start..self.light_rays.len(), count }
    }

    /// The share of ambient light that reaches the surface. Its rays are answered.
    pub(crate) fn openness(&self, surroundings: &Surroundings) -> Vec3 {
        self.light_rays.sum(surroundings.rays.clone()) / surroundings.count.max(1) as f32
    }
}

/// How much a smooth normal's light is weakened where the triangle itself turns away from the
/// light, so that shadows do not end at the edges of triangles: Chiang, Li and Burley, "Taming the
/// Shadow Terminator" (SIGGRAPH 2019 Talks). 1 for flat triangles.
fn terminator(surface: &Surface<'_>, to_light: DVec3) -> f64 {
    let (n_l, g_l) = (surface.normal.dot(to_light), surface.at.facing.dot(to_light));
    let n_g = surface.normal.dot(surface.at.facing);
    if g_l <= 0.0 {
        return 0.0;
    }
    let g = (g_l / (n_l * n_g)).clamp(0.0, 1.0);
    g * (1.0 + g * (1.0 - g))
}

impl Lamp {
    /// The distance and radiance of the lamp's shining surface along a ray, if it has one there.
    pub(crate) fn seen(&self, origin: DVec3, direction: DVec3) -> Option<(f64, Vec3)> {
        match self {
            Self::Rectangle(panel) => panel.seen(origin, direction),
            _ => None,
        }
    }
}
