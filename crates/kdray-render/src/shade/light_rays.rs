//! Rays towards light, gathered to be answered together.

use super::shadow::transmittances;
use crate::world::World;
use glam::Vec3;
use kdray::Ray;
use std::ops::Range;

/// Rays from surfaces towards lamps and the surroundings, with the light that comes along each.
///
/// Surfaces push their rays, all are answered in one batch, then each surface takes the sum over
/// its own. It is used as a stack: what a mirrored ray meets pushes and drops its rays while those
/// of the mirror still wait below.
#[derive(Default)]
pub(crate) struct LightRays {
    rays: Vec<Ray>,
    promised: Vec<Promise>,
    /// The share of light that comes through along the rays that are answered.
    through: Vec<Vec3>,
}

/// Light that comes along a ray if nothing is in its way.
#[derive(Clone, Copy, Debug)]
struct Promise {
    light: Vec3,
    /// The number of rays whose mean counts.
    of: f32,
}

impl LightRays {
    /// The number of rays.
    pub(crate) fn len(&self) -> usize {
        self.rays.len()
    }

    /// Adds a ray, along which comes `light` if nothing is in its way; the mean `of` so many rays
    /// counts.
    pub(crate) fn push(&mut self, ray: Ray, light: Vec3, of: u32) {
        self.rays.push(ray);
        self.promised.push(Promise { light, of: of as f32 });
    }

    /// Finds what is in the way of the rays from that of index `start` on.
    pub(crate) fn answer(&mut self, world: &World, start: usize) {
        let Self { rays, through, .. } = self;
        through.resize(rays.len(), Vec3::ZERO);
        let through = &mut through[start..];
        transmittances(world, &rays[start..], |index, share| through[index] = share);
    }

    /// The light that comes along these rays, which are answered.
    pub(crate) fn sum(&self, rays: Range<usize>) -> Vec3 {
        let answered = self.promised[rays.clone()].iter().zip(&self.through[rays]);
        answered
            .fold(Vec3::ZERO, |sum, (promise, &through)| sum + promise.light * through / promise.of)
    }

    /// Drops the rays from that of index `start` on.
    pub(crate) fn truncate(&mut self, start: usize) {
        self.rays.truncate(start);
        self.promised.truncate(start);
        self.through.truncate(start);
    }
}
