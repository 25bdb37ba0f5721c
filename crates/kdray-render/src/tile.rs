//! All that is computed for the pixels of a tile.

use crate::camera::View;
use crate::camera_rays::{CameraRays, Lens};
use crate::film::PixelValues;
use crate::light::Lamp;
use crate::options::{PictureKind, RenderOptions};
use crate::shade::{Surroundings, Tracer};
use crate::surface::{Surface, opacity};
use crate::world::World;
use glam::Vec3;
use kdray::primitives::HitRule;
use kdray::traverse::{Counters, Trace};
use kdray::{Hit, Ray};
use std::ops::Range;

/// Occlusion rays per camera ray for [`PictureKind::AmbientOcclusion`], at the least.
const LEAST_OCCLUSION_RAYS: u32 = 4;

/// The share of the scene's diagonal within which surfaces block ambient light.
const OCCLUSION_SHARE: f64 = 0.1;

/// Rays that are gathered at once: enough to keep a batch busy, few enough for the caches.
const GATHERED: usize = 1024;

/// Camera rays that are gathered at once for packets: those of a large packet.
const GATHERED_IN_PACKETS: usize = 512;

/// Rays that are gathered at once at the most, light rays among them.
const MOST_GATHERED: usize = 1 << 16;

/// Computes the pixels of a tile.
pub(crate) struct TileTracer<'a> {
    tracer: Tracer<'a>,
    camera_rays: CameraRays,
    lens: Lens<'a>,
    options: &'a RenderOptions,
    /// How many camera rays are followed at once.
    portion: usize,
}

impl<'a> TileTracer<'a> {
    pub(crate) fn new(
        world: &'a World,
        view: &'a View,
        lamps: &'a [Lamp],
        options: &'a RenderOptions,
    ) -> Self {
        let diagonal = world.bounds().diagonal();
        let distance = options.occlusion_distance.unwrap_or(OCCLUSION_SHARE * diagonal);
        let tracer = Tracer::new(world, lamps, options, distance);
        let to_lamps: usize = lamps.iter().map(|lamp| tracer.lamp_rays(lamp, 0) as usize).sum();
        let rays = 1 + to_lamps + occlusion_rays(options) as usize;
        let portion = match options.packets {
            true => GATHERED_IN_PACKETS.min(MOST_GATHERED / rays),
            false => GATHERED / rays,
        };
        let (camera_rays, lens) = (CameraRays::default(), Lens::new(view, options));
        Self { tracer, camera_rays, lens, options, portion: portion.max(1) }
    }

    /// How many rays were shot.
    pub(crate) fn rays(&self) -> u64 {
        self.tracer.rays()
    }

    /// The pixels of a tile that the options ask for, with the values that they ask for.
    pub(crate) fn trace(&mut self, tile: &[[usize; 2]]) -> Vec<([usize; 2], PixelValues)> {
        let options = self.options;
        let (window, strata) = (options.window(), options.strata());
        let pixels = tile.iter().copied().filter(|&pixel| window.contains(pixel));
        let pixels: &[[usize; 2]] = &pixels.collect::<Vec<_>>();
        let mut values = vec![PixelValues::default(); pixels.len()];
        let wanted = |kinds: &[PictureKind]| options.all_layers || kinds.contains(&options.picture);
        if wanted(&[PictureKind::Shaded]) {
            let means = self.means(pixels, strata.clone(), Self::push_radiances);
            for (values, [r, g, b]) in values.iter_mut().zip(means) {
                values.color = [r, g, b, 1.0];
            }
        }
        if wanted(&[PictureKind::Depth, PictureKind::Normal, PictureKind::PrimitiveId]) {
            self.trace_middles(pixels, &mut values);
        }
        if wanted(&[PictureKind::AmbientOcclusion]) {
            let means = self.means(pixels, strata.clone(), Self::push_openness);
            for (values, [occlusion]) in values.iter_mut().zip(means) {
                values.occlusion = occlusion;
            }
        }
        if wanted(&[PictureKind::Cost, PictureKind::CostNodes, PictureKind::CostPrimitives]) {
            let means = self.means(pixels, strata, Self::push_costs);
            for (values, [nodes, primitives]) in values.iter_mut().zip(means) {
                (values.nodes, values.primitives) = (nodes, primitives);
            }
        }
        if wanted(&[PictureKind::PacketCost, PictureKind::PacketSize]) {
            // The work for a ray depends on those that go with it.
            let means = self.means(tile, 0..options.samples, Self::push_packet_work);
            let kept = tile.iter().zip(means).filter(|&(&pixel, _)| window.contains(pixel));
            for (values, (_, [cost, size])) in values.iter_mut().zip(kept) {
                (values.packet_cost, values.packet_size) = (cost, size);
            }
        }
        pixels.iter().copied().zip(values).collect()
    }

    /// The mean over each pixel's camera rays of what `push` adds for each ray of a portion. Those of
    /// `samples` are traced, if some of their portion are asked for, and those that are asked for count.
    fn means<const N: usize>(
        &mut self,
        pixels: &[[usize; 2]],
        samples: Range<u32>,
        push: impl Fn(&mut Self, &mut Vec<[f32; N]>),
    ) -> Vec<[f32; N]> {
        let (window, strata) = (self.options.window(), self.options.strata());
        let each = samples.len();
        let ray = |i: usize| (pixels[i / each], samples.start + (i % each) as u32);
        let counts = |i: usize| {
            let (pixel, sample) = ray(i);
            window.contains(pixel) && strata.contains(&sample)
        };
        let mut sums = vec![[0.0_f64; N]; pixels.len()];
        let mut found = Vec::with_capacity(self.portion);
        let all = pixels.len() * each;
        for first in (0..all).step_by(self.portion) {
            let portion = first..(first + self.portion).min(all);
            if !portion.clone().any(counts) {
                continue;
            }
            let rays = portion.clone().map(ray);
            self.camera_rays.fill(rays.map(|(pixel, sample)| self.lens.sample(pixel, sample)));
            push(self, &mut found);
            for (i, values) in portion.zip(found.drain(..)).filter(|&(i, _)| counts(i)) {
                let sums = sums[i / each].iter_mut();
                sums.zip(values).for_each(|(sum, value)| *sum += f64::from(value));
            }
        }
        let count = strata.len() as f64;
        sums.iter().map(|sums| sums.map(|sum| (sum / count) as f32)).collect()
    }

    /// The light that comes back along each of the rays.
    fn push_radiances(&mut self, radiances: &mut Vec<[f32; 3]>) {
        self.find_hits();
        self.tracer.radiances(&self.camera_rays, radiances);
    }

    /// Depth, normal and id, which have no sensible mean, along the rays through the middles.
    fn trace_middles(&mut self, pixels: &[[usize; 2]], values: &mut [PixelValues]) {
        self.camera_rays.fill(pixels.iter().map(|&pixel| self.lens.middle(pixel)));
        self.find_hits();
        let world = self.tracer.world;
        for ((ray, hit, _), values) in self.camera_rays.iter().zip(values) {
            let Some(hit) = behind_cut_outs(world, ray, hit, &mut ()) else {
                values.depth = f32::INFINITY;
                values.primitive_id = u32::MAX;
                continue;
            };
            values.depth = hit.t as f32;
            values.normal = Surface::new(world, ray, &hit).normal.as_vec3().to_array();
            values.primitive_id = hit.primitive_id;
        }
    }

    /// The share of the sky that the first surface on each of the rays sees.
    fn push_openness(&mut self, shares: &mut Vec<[f32; 1]>) {
        self.find_hits();
        let Self { tracer, camera_rays, options, .. } = self;
        let mut seen: Vec<Option<Surroundings>> = Vec::with_capacity(camera_rays.len());
        seen.extend(camera_rays.iter().map(|(ray, hit, sampler)| {
            let hit = behind_cut_outs(tracer.world, ray, hit, &mut ())?;
            let surface = Surface::new(tracer.world, ray, &hit);
            Some(tracer.push_to_surroundings(&surface, occlusion_rays(options), sampler))
        }));
        tracer.answer(0);
        shares.extend(seen.iter().map(|seen| {
            let share = |seen| tracer.openness(seen).dot(Vec3::ONE) / 3.0;
            [seen.as_ref().map_or(1.0, share)]
        }));
        tracer.light_rays.truncate(0);
    }

    /// What the lecture's traversal does to find the first hits: the fast kernels are not watched.
    fn push_costs(&mut self, costs: &mut Vec<[f32; 2]>) {
        self.tracer.count_rays(self.camera_rays.len());
        let world = self.tracer.world;
        costs.extend(self.camera_rays.rays().iter().map(|ray| {
            let mut counters = Counters::default();
            let hit = world.scene().shapes().closest_hit_traced(ray, &mut counters);
            behind_cut_outs(world, ray, hit.as_ref(), &mut counters);
            [counters.nodes() as f32, counters.primitives as f32]
        }));
    }

    /// What it takes to find the first hits in packets: the same for all rays of a portion.
    fn push_packet_work(&mut self, values: &mut Vec<[f32; 2]>) {
        let rays = self.camera_rays.len();
        self.tracer.count_rays(rays);
        let scene = self.tracer.world.scene();
        let work = self.camera_rays.find_hits_in_packets(scene, self.lens.common());
        let cost = (work.nodes + work.triangles + work.tests) as f32 / rays as f32;
        let size = rays as f32 / (work.packets + work.left) as f32;
        values.extend(std::iter::repeat_n([cost, size], rays));
    }

    /// Finds the closest hits of the camera rays.
    fn find_hits(&mut self) {
        self.tracer.count_rays(self.camera_rays.len());
        let scene = self.tracer.world.scene();
        if self.options.packets {
            self.camera_rays.find_hits_in_packets(scene, self.lens.common());
        } else {
            self.camera_rays.find_hits(scene);
        }
    }
}

/// Occlusion rays per camera ray.
fn occlusion_rays(options: &RenderOptions) -> u32 {
    options.ambient_rays.max(LEAST_OCCLUSION_RAYS)
}

/// `hit`, the closest, if it is on a surface that is there; else the next one that is.
fn behind_cut_outs(
    world: &World,
    ray: &Ray,
    hit: Option<&Hit>,
    trace: &mut impl Trace,
) -> Option<Hit> {
    let is_there = |hit: &Hit| opacity(world, hit) > 0.0;
    let hit = hit?;
    if is_there(hit) {
        return Some(*hit);
    }
    // Another surface may lie at the t of the cut-out.
    let rest = ray.with_interval(hit.t, ray.interval.t_max);
    let shapes = world.scene().shapes();
    shapes.all_hits_traced(&rest, HitRule::Crossing, trace).find(is_there)
}
