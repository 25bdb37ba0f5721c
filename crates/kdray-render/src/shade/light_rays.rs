//! Rays towards light, gathered to be answered together.

use super::shadow::{in_batch, in_packets};
use crate::bundle::Bundle;
use crate::light::Lamp;
use crate::world::World;
use glam::Vec3;
use kdray::Ray;
use kdray::geometry::Common;
use std::ops::Range;

/// Rays from surfaces towards lamps and the surroundings, with the light that comes along each.
///
/// Surfaces push their rays, all are answered together, then each surface takes the sum over
/// its own. It is used as a stack: what a mirrored ray meets pushes and drops its rays while those
/// of the mirror still wait below.
pub(crate) struct LightRays {
    rays: Vec<Ray>,
    promised: Vec<Promise>,
    /// The share of light that comes through along the rays that are answered.
    through: Vec<Vec3>,
    packets: Option<Packets>,
    /// The places of the rays that are answered in a batch.
    alone: Vec<usize>,
}

/// Light that comes along a ray if nothing is in its way.
#[derive(Clone, Copy, Debug)]
struct Promise {
    light: Vec3,
    /// The number of rays whose mean counts.
    of: f32,
    toward: Toward,
}

/// Where light is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Toward {
    /// At the lamp of that index.
    Lamp(u32),
    /// In the surroundings.
    Surroundings,
}

/// What is needed to answer rays in packets.
struct Packets {
    /// What the rays to each lamp share.
    lamps: Vec<Option<Common>>,
    /// The places of the rays to each lamp.
    to_lamps: Vec<Vec<usize>>,
    bundle: Bundle,
}

/// Fewer rays to a lamp are answered in a batch with all others.
const LEAST: usize = 64;

impl LightRays {
    /// None yet; with packets of the rays to each of `lamps` if those are given.
    pub(crate) fn new(lamps: Option<&[Lamp]>) -> Self {
        let packets = lamps.map(|lamps| Packets {
            lamps: lamps.iter().map(Lamp::common).collect(),
            to_lamps: vec![Vec::new(); lamps.len()],
            bundle: Bundle::default(),
        });
        let (rays, promised, through) = (Vec::new(), Vec::new(), Vec::new());
        Self { rays, promised, through, packets, alone: Vec::new() }
    }

    /// The number of rays.
    pub(crate) fn len(&self) -> usize {
        self.rays.len()
    }

    /// Adds a ray, along which comes `light` if nothing is in its way; the mean `of` so many rays
    /// counts.
    pub(crate) fn push(&mut self, ray: Ray, toward: Toward, light: Vec3, of: u32) {
        self.rays.push(ray);
        self.promised.push(Promise { light, of: of as f32, toward });
    }

    /// Finds what is in the way of the rays from that of index `start` on.
    pub(crate) fn answer(&mut self, world: &World, start: usize) {
        let Self { rays, promised, through, packets, alone } = self;
        through.resize(rays.len(), Vec3::ZERO);
        let (rays, promised, through) = (&rays[start..], &promised[start..], &mut through[start..]);
        alone.clear();
        match packets {
            Some(packets) if rays.len() >= LEAST => {
                packets.answer(world, rays, promised, through, alone);
            }
            _ => alone.extend(0..rays.len()),
        }
        in_batch(world, rays, alone, through);
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

impl Packets {
    /// Answers the rays to each lamp together if they share something; leaves the others `alone`.
    fn answer(
        &mut self,
        world: &World,
        rays: &[Ray],
        promised: &[Promise],
        through: &mut [Vec3],
        alone: &mut Vec<usize>,
    ) {
        let Self { lamps, to_lamps, bundle } = self;
        to_lamps.iter_mut().for_each(Vec::clear);
        for (place, promise) in promised.iter().enumerate() {
            match promise.toward {
                Toward::Lamp(lamp) => to_lamps[lamp as usize].push(place),
                Toward::Surroundings => alone.push(place),
            }
        }
        for (common, places) in lamps.iter().zip(to_lamps) {
            match common {
                Some(common) if places.len() >= LEAST => {
                    in_packets(world, *common, bundle, rays, places, through);
                }
                _ => alone.extend_from_slice(places),
            }
        }
    }
}
