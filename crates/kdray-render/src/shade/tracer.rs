//! Who follows rays, and what is known of a ray.

use super::first::First;
use super::light_rays::LightRays;
use crate::light::Lamp;
use crate::options::RenderOptions;
use crate::sampling::Sampler;
use crate::world::World;
use glam::Vec3;

/// Contributions to a pixel below this share are not followed (Hall and Greenberg's adaptive
/// depth control, 1983): half of what an 8-bit PNG can show in the shadows.
pub(super) const NEGLIGIBLE: f32 = 1.0 / 1024.0;

/// Follows rays through one world. Each tile has its own.
pub(crate) struct Tracer<'a> {
    pub(crate) world: &'a World,
    pub(crate) lamps: &'a [Lamp],
    pub(crate) options: &'a RenderOptions,
    pub(crate) occlusion_distance: f64,
    pub(crate) light_rays: LightRays,
    /// First surfaces; kept for their room.
    pub(super) firsts: Vec<Option<First<'a>>>,
    rays: u64,
}

/// How a ray came about.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Path {
    /// How often it was mirrored or refracted.
    pub(crate) bounces: u32,
    /// The most that its light adds to the pixel, as a share.
    pub(crate) weight: f32,
    /// Whether it sees the lamps' surfaces: not where their highlight is computed otherwise.
    pub(crate) sees_lamps: bool,
    /// Its random numbers.
    pub(crate) sampler: Sampler,
}

impl Path {
    /// The path of a camera ray.
    pub(crate) fn primary(sampler: Sampler) -> Self {
        Self { bounces: 0, weight: 1.0, sees_lamps: true, sampler }
    }

    pub(super) fn bounced(&self, purpose: u32, weight: Vec3, sees_lamps: bool) -> Self {
        let sampler = self.sampler.fork(purpose);
        let weight = self.weight * weight.max_element();
        Self { bounces: self.bounces + 1, weight, sees_lamps, sampler }
    }
}

impl<'a> Tracer<'a> {
    pub(crate) fn new(
        world: &'a World,
        lamps: &'a [Lamp],
        options: &'a RenderOptions,
        occlusion_distance: f64,
    ) -> Self {
        let light_rays = LightRays::new(options.packets.then_some(lamps));
        let firsts = Vec::new();
        Self { world, lamps, options, occlusion_distance, light_rays, firsts, rays: 0 }
    }

    /// How many rays were shot.
    pub(crate) fn rays(&self) -> u64 {
        self.rays
    }

    pub(crate) fn count_rays(&mut self, count: usize) {
        self.rays += count as u64;
    }

    /// Radiance that is not worth a shadow ray.
    pub(crate) fn negligible(&self) -> f32 {
        NEGLIGIBLE / 16.0 / self.options.exposure.max(f32::MIN_POSITIVE)
    }

    /// Finds what is in the way of the light rays from that of index `start` on.
    pub(crate) fn answer(&mut self, start: usize) {
        self.light_rays.answer(self.world, start);
        self.count_rays(self.light_rays.len() - start);
    }
}
