//! Light straight from the lamps, and ambient light.

use super::gloss::Gloss;
use super::shadow::SHORT_OF_LIGHT;
use super::whitted::{Path, Tracer};
use crate::light::{Arrival, Lamp, Source};
use crate::sampling::{Sampler, cosine_hemisphere, tangents};
use crate::surface::Surface;
use glam::{DVec3, Vec3};
use std::f32::consts::PI;

/// What the random numbers of direct light are for.
const LAMPS: u32 = 0x100;
const OCCLUSION: u32 = 0x101;

impl Tracer<'_> {
    /// The light of all lamps that the surface sends to the viewer, in its diffuse share `diffuse`
    /// and its highlight.
    pub(crate) fn direct(
        &self,
        surface: &Surface<'_>,
        diffuse: Vec3,
        gloss: &Gloss,
        path: &Path,
    ) -> Vec3 {
        let mut sum = Vec3::ZERO;
        for (index, lamp) in self.lamps.iter().enumerate() {
            // Soft shadows that are seen in a mirror need no more rays than the mirror has.
            let soft = if path.bounces == 0 { self.options.light_samples } else { 1 };
            let count = if lamp.is_sharp() { 1 } else { soft };
            let sampler = path.sampler.fork(LAMPS).fork(index as u32);
            for i in 0..count {
                let arrival = lamp.arrival(surface.at.point.position(), sampler.point(i, count));
                sum += self.reflected(surface, diffuse, gloss, &arrival) / count as f32;
            }
        }
        sum
    }

    fn reflected(
        &self,
        surface: &Surface<'_>,
        diffuse: Vec3,
        gloss: &Gloss,
        arrival: &Arrival,
    ) -> Vec3 {
        let (ray, to_light) = match arrival.from {
            Source::Far(to_light) => (surface.at.ray_along(to_light), to_light),
            Source::Point(position) => {
                let ray = surface.at.ray_to(position).with_interval(0.0, SHORT_OF_LIGHT);
                (ray, (position - surface.at.point.position()).normalize_or_zero())
            }
        };
        let cos = surface.normal.dot(to_light);
        let smoothed = terminator(surface, to_light);
        if cos <= 0.0 || smoothed <= 0.0 || arrival.irradiance.max_element() <= 0.0 {
            return Vec3::ZERO;
        }
        let reflected = (diffuse / PI * smoothed as f32 + gloss.value(to_light))
            * arrival.irradiance
            * cos as f32;
        // A light at the very point has infinite irradiance, and a NaN would spread.
        if !reflected.is_finite() || reflected.max_element() < self.negligible() {
            return Vec3::ZERO;
        }
        reflected * self.transmittance(&ray)
    }

    /// The share of ambient light that reaches the surface: by rays spread as the cosine, up to
    /// the occlusion distance.
    pub(crate) fn ambient_share(
        &self,
        surface: &Surface<'_>,
        count: u32,
        sampler: Sampler,
    ) -> Vec3 {
        let sampler = sampler.fork(OCCLUSION);
        let (x, y) = tangents(surface.normal);
        let mut sum = Vec3::ZERO;
        for i in 0..count {
            let local = cosine_hemisphere(sampler.point(i, count));
            let direction = x * local.x + y * local.y + surface.normal * local.z;
            if direction.dot(surface.at.facing) > 0.0 {
                let ray =
                    surface.at.ray_along(direction).with_interval(0.0, self.occlusion_distance);
                sum += self.transmittance(&ray);
            }
        }
        sum / count.max(1) as f32
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
