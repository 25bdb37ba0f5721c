//! Rays through the camera: where they go, and many of them, gathered to be answered together.

use crate::bundle::Bundle;
use crate::camera::View;
use crate::options::RenderOptions;
use crate::sampling::Sampler;
use kdray::geometry::Common;
use kdray::{Hit, PacketWork, Ray, Scene};

/// What the random numbers of a camera ray are for.
const LENS: u32 = 0x200;

/// From pixels to camera rays.
pub(crate) struct Lens<'a> {
    view: &'a View,
    options: &'a RenderOptions,
}

impl<'a> Lens<'a> {
    pub(crate) fn new(view: &'a View, options: &'a RenderOptions) -> Self {
        Self { view, options }
    }

    /// What all rays share.
    pub(crate) fn common(&self) -> Common {
        self.view.common()
    }

    /// The ray of that index through a pixel, with its random numbers.
    pub(crate) fn sample(&self, pixel: [usize; 2], sample: u32) -> (Ray, Sampler) {
        let samples = self.options.samples;
        let sampler = Sampler::new(self.options.seed, pixel, sample, samples);
        let within = if samples == 1 { [0.5; 2] } else { sampler.fork(LENS).point(0, 1) };
        (self.through(pixel, within), sampler)
    }

    /// The ray through the middle of a pixel, as if it were the only one.
    pub(crate) fn middle(&self, pixel: [usize; 2]) -> (Ray, Sampler) {
        (self.through(pixel, [0.5; 2]), Sampler::new(self.options.seed, pixel, 0, 1))
    }

    /// The ray through the point of a pixel that lies `within` it, from 0 to 1 on both axes.
    fn through(&self, [x, y]: [usize; 2], within: [f64; 2]) -> Ray {
        let x = (x as f64 + within[0]) / self.options.width as f64;
        let y = (y as f64 + within[1]) / self.options.height as f64;
        self.view.ray(x, y)
    }
}

/// Rays from the camera with their random numbers, then with what each hits first.
#[derive(Default)]
pub(crate) struct CameraRays {
    rays: Vec<Ray>,
    samplers: Vec<Sampler>,
    hits: Vec<Option<Hit>>,
    bundle: Bundle,
}

impl CameraRays {
    /// Replaces all rays.
    pub(crate) fn fill(&mut self, rays: impl Iterator<Item = (Ray, Sampler)>) {
        self.rays.clear();
        self.samplers.clear();
        self.hits.clear();
        for (ray, sampler) in rays {
            self.rays.push(ray);
            self.samplers.push(sampler);
        }
    }

    /// The number of rays.
    pub(crate) fn len(&self) -> usize {
        self.rays.len()
    }

    /// The rays.
    pub(crate) fn rays(&self) -> &[Ray] {
        &self.rays
    }

    /// Finds the closest hits of all rays, in a batch.
    pub(crate) fn find_hits(&mut self, scene: &Scene) {
        self.hits.resize(self.rays.len(), None);
        scene.closest_hits(&self.rays, &mut self.hits);
    }

    /// Finds the closest hits of all rays, which share `common`, in packets. Gives what it took.
    pub(crate) fn find_hits_in_packets(&mut self, scene: &Scene, common: Common) -> PacketWork {
        self.bundle.fill(common, self.rays.iter());
        let (hits, work) = self.bundle.closest_hits(scene, f64::INFINITY);
        self.hits.extend((0..self.rays.len()).map(|index| hits.get(index)));
        work
    }

    /// Each ray with its closest hit, which has been found, and its random numbers.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&Ray, Option<&Hit>, Sampler)> {
        let hits = self.hits.iter().map(Option::as_ref);
        let found = self.rays.iter().zip(hits).zip(&self.samplers);
        found.map(|((ray, hit), &sampler)| (ray, hit, sampler))
    }
}
