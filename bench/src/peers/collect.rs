//! All hits, by those who have such a query.

use super::ROUNDS;
use crate::embree::{Embree, Quality, SingleRay};
use crate::error::BenchError;
use crate::measure::{median, timed_here};
use crate::rays::Ray;
use crate::reference::exact_ray;
use kdray::{BuildOptions, Scene, TriangleMesh};

/// The t of all hits of all rays, and how long it took.
#[derive(Default)]
pub(super) struct Lists {
    /// Where each ray's hits begin, and where the last one's end.
    pub(super) splits: Vec<u64>,
    /// In the order in which they were found.
    pub(super) t: Vec<f32>,
    /// The triangles: written like the rest, for nobody wants hits without.
    ids: Vec<u32>,
    /// Seconds of processor time.
    pub(super) seconds: f64,
}

impl Lists {
    fn begin(&mut self) {
        self.t.clear();
        self.ids.clear();
        self.splits.clear();
        self.splits.push(0);
    }

    fn push(&mut self, t: f32, id: u32) {
        self.t.push(t);
        self.ids.push(id);
    }

    fn end_ray(&mut self) {
        self.splits.push(self.t.len() as u64);
    }

    /// Traces in rounds; `each` adds the hits of a ray.
    fn traced<R>(rays: &[R], mut each: impl FnMut(&R, &mut Self)) -> Self {
        let mut lists = Self::default();
        let mut round = || {
            let trace = || {
                lists.begin();
                for ray in rays {
                    each(ray, &mut lists);
                    lists.end_ray();
                }
            };
            timed_here(trace).1.cpu
        };
        let seconds = median((0..ROUNDS).map(|_| round()).collect());
        Self { seconds, ..lists }
    }
}

/// kdray's `all_hits_into`.
pub(super) fn kdray(mesh: &TriangleMesh, rays: &[Ray]) -> Result<Lists, BenchError> {
    let scene = Scene::build(mesh.clone(), &BuildOptions::default())?;
    let rays: Vec<kdray::Ray> = rays.iter().map(exact_ray).collect();
    let mut hits = Vec::new();
    Ok(Lists::traced(&rays, |ray, lists| {
        scene.all_hits_into(ray, &mut hits);
        hits.iter().for_each(|hit| lists.push(hit.t as f32, hit.primitive_id));
    }))
}

/// kdray's `each_all_hits`: the rays in turns, whose hits lie together. They arrive in another order than the rays', and
/// to put them into it takes part of the time, for everybody else's are.
pub(super) fn kdray_batch(mesh: &TriangleMesh, rays: &[Ray]) -> Result<Lists, BenchError> {
    let scene = Scene::build(mesh.clone(), &BuildOptions::default())?;
    let rays: Vec<kdray::Ray> = rays.iter().map(exact_ray).collect();
    let (mut arrived, mut lists) = (Lists::default(), Lists::default());
    let mut places = vec![0..0; rays.len()];
    let mut round = |_| {
        let trace = || {
            arrived.begin();
            lists.begin();
            scene.each_all_hits(&rays, |index, hits| {
                let start = arrived.t.len();
                hits.iter().for_each(|hit| arrived.push(hit.t as f32, hit.primitive_id));
                places[index] = start..arrived.t.len();
            });
            for place in &places {
                lists.t.extend_from_slice(&arrived.t[place.clone()]);
                lists.ids.extend_from_slice(&arrived.ids[place.clone()]);
                lists.end_ray();
            }
        };
        timed_here(trace).1.cpu
    };
    let seconds = median((0..ROUNDS).map(&mut round).collect());
    Ok(Lists { seconds, ..lists })
}

/// Embree's `rtcIntersect1` with a filter that collects, sorted.
pub(super) fn embree(
    library: &Embree,
    quality: Quality,
    mesh: &TriangleMesh,
    rays: &[Ray],
) -> Result<Lists, BenchError> {
    let scene = library.collecting_scene(mesh, quality)?;
    let ray = |ray: &Ray| SingleRay::new(ray.origin, ray.direction, ray.t_max);
    let rays: Vec<SingleRay> = rays.iter().map(ray).collect();
    let mut hits = Vec::new();
    Ok(Lists::traced(&rays, |ray, lists| {
        scene.all(ray, &mut hits);
        hits.iter().for_each(|&(t, id)| lists.push(t, id));
    }))
}
