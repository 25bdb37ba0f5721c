//! All that is computed for one pixel.

use crate::camera::View;
use crate::film::PixelValues;
use crate::light::Lamp;
use crate::options::{PictureKind, RenderOptions};
use crate::sampling::Sampler;
use crate::shade::{Path, Tracer};
use crate::surface::{Surface, opacity};
use crate::world::World;
use glam::Vec3;
use kdray::primitives::HitRule;
use kdray::traverse::{Counters, Trace};
use kdray::{Hit, Ray};

/// Occlusion rays per camera ray for [`PictureKind::AmbientOcclusion`], at the least.
const LEAST_OCCLUSION_RAYS: u32 = 4;

/// The share of the scene's diagonal within which surfaces block ambient light.
const OCCLUSION_SHARE: f64 = 0.1;

/// What the random numbers of a camera ray are for.
const LENS: u32 = 0x200;

/// Computes pixels. Each tile has its own.
pub(crate) struct PixelTracer<'a> {
    tracer: Tracer<'a>,
    view: &'a View,
    options: &'a RenderOptions,
}

impl<'a> PixelTracer<'a> {
    pub(crate) fn new(
        world: &'a World,
        view: &'a View,
        lamps: &'a [Lamp],
        options: &'a RenderOptions,
    ) -> Self {
        let diagonal = world.bounds().diagonal();
        let distance = options.occlusion_distance.unwrap_or(OCCLUSION_SHARE * diagonal);
        Self { tracer: Tracer::new(world, lamps, options, distance), view, options }
    }

    /// How many rays were shot.
    pub(crate) fn rays(&self) -> u64 {
        self.tracer.rays()
    }

    /// The values of a pixel that the options ask for.
    pub(crate) fn trace(&self, pixel: [usize; 2]) -> PixelValues {
        let mut values = PixelValues::default();
        let wanted = |kinds: &[PictureKind]| {
            self.options.all_layers || kinds.contains(&self.options.picture)
        };
        if wanted(&[PictureKind::Shaded]) {
            let [r, g, b] = self.mean(pixel, |ray, sampler| {
                self.tracer.radiance(ray, &Path::primary(sampler)).to_array()
            });
            values.color = [r, g, b, 1.0];
        }
        if wanted(&[PictureKind::Depth, PictureKind::Normal, PictureKind::PrimitiveId]) {
            self.trace_middle(pixel, &mut values);
        }
        if wanted(&[PictureKind::AmbientOcclusion]) {
            [values.occlusion] = self.mean(pixel, |ray, sampler| [self.openness(ray, sampler)]);
        }
        if wanted(&[PictureKind::Cost, PictureKind::CostNodes, PictureKind::CostPrimitives]) {
            [values.nodes, values.primitives] = self.mean(pixel, |ray, _| self.cost(ray));
        }
        values
    }

    /// The mean of `value` over the pixel's camera rays.
    fn mean<const N: usize>(
        &self,
        [x, y]: [usize; 2],
        value: impl Fn(Ray, Sampler) -> [f32; N],
    ) -> [f32; N] {
        let samples = self.options.samples;
        let mut sum = [0.0_f64; N];
        for sample in 0..samples {
            let sampler = Sampler::new(self.options.seed, [x, y], sample, samples);
            let within = if samples == 1 { [0.5; 2] } else { sampler.fork(LENS).point(0, 1) };
            let values = value(self.camera_ray([x, y], within), sampler);
            for (sum, value) in sum.iter_mut().zip(values) {
                *sum += f64::from(value);
            }
        }
        sum.map(|sum| (sum / f64::from(samples)) as f32)
    }

    /// The ray through the point of a pixel that lies `within` it, from 0 to 1 on both axes.
    fn camera_ray(&self, [x, y]: [usize; 2], within: [f64; 2]) -> Ray {
        let x = (x as f64 + within[0]) / self.options.width as f64;
        let y = (y as f64 + within[1]) / self.options.height as f64;
        self.view.ray(x, y)
    }

    /// Depth, normal and id, which have no sensible mean, along the ray through the middle.
    fn trace_middle(&self, pixel: [usize; 2], values: &mut PixelValues) {
        let ray = self.camera_ray(pixel, [0.5; 2]);
        let Some(hit) = self.first_hit(ray) else {
            values.depth = f32::INFINITY;
            values.primitive_id = u32::MAX;
            return;
        };
        values.depth = hit.t as f32;
        values.normal = Surface::new(self.tracer.world, &ray, &hit).normal.as_vec3().to_array();
        values.primitive_id = hit.primitive_id;
    }

    fn openness(&self, ray: Ray, sampler: Sampler) -> f32 {
        let Some(hit) = self.first_hit(ray) else { return 1.0 };
        let surface = Surface::new(self.tracer.world, &ray, &hit);
        let count = self.options.ambient_rays.max(LEAST_OCCLUSION_RAYS);
        self.tracer.ambient_share(&surface, count, sampler).dot(Vec3::ONE) / 3.0
    }

    /// What the lecture's traversal does to find the first hit: the fast kernels are not watched.
    fn cost(&self, ray: Ray) -> [f32; 2] {
        self.tracer.count_ray();
        let mut counters = Counters::default();
        let shapes = self.tracer.world.scene().shapes();
        let hit = shapes.closest_hit_traced(&ray, &mut counters);
        self.behind_cut_outs(&ray, hit, &mut counters);
        [counters.nodes() as f32, counters.primitives as f32]
    }

    /// The first hit on a surface that is there.
    fn first_hit(&self, ray: Ray) -> Option<Hit> {
        self.tracer.count_ray();
        let hit = self.tracer.world.scene().closest_hit(&ray);
        self.behind_cut_outs(&ray, hit, &mut ())
    }

    /// `hit`, the closest, if it is on a surface that is there; else the next one that is.
    fn behind_cut_outs(&self, ray: &Ray, hit: Option<Hit>, trace: &mut impl Trace) -> Option<Hit> {
        let world = self.tracer.world;
        let is_there = |hit: &Hit| opacity(world, hit) > 0.0;
        let hit = hit?;
        if is_there(&hit) {
            return Some(hit);
        }
        // Another surface may lie at the t of the cut-out.
        let rest = ray.with_interval(hit.t, ray.interval.t_max);
        let shapes = world.scene().shapes();
        shapes.all_hits_traced(&rest, HitRule::Crossing, trace).find(is_there)
    }
}
