//! obvhs: a compressed eight-wide BVH, and a binary one, in their best settings for rays.
//!
//! As its examples advise: `very_slow_build`, and triangles made ready for rays (`RtTriangle`) and
//! laid out in the order of the leaves.

use crate::contender::{Built, Contender, Found, Job, Trace, one_by_one};
use crate::error::BenchError;
use crate::rays;
use crate::workers::Workers;
use kdray::TriangleMesh;
use obvhs::{
    BvhBuildParams, bvh2::builder::build_bvh2_from_tris, cwbvh::builder::build_cwbvh_from_tris,
    ray::Ray, ray::RayHit, rt_triangle::RtTriangle, triangle::Triangle,
};
use std::time::Duration;

/// How trees are built.
const PARAMS: BvhBuildParams = BvhBuildParams::very_slow_build();

/// The compressed wide BVH.
pub(super) struct CwBvh;

/// The binary BVH.
pub(super) struct Bvh2;

/// A tree, and the triangles in the order of its leaves.
struct Tree<B> {
    bvh: B,
    triangles: Vec<RtTriangle>,
}

impl Contender for CwBvh {
    fn name(&self) -> &'static str {
        "obvhs cwbvh"
    }

    fn build<'a>(
        &self,
        mesh: &'a TriangleMesh,
        workers: &Workers,
    ) -> Result<Box<dyn Built + 'a>, BenchError> {
        Ok(workers.run(|| {
            let all = triangles(mesh);
            let bvh = build_cwbvh_from_tris(&all, PARAMS, &mut Duration::default());
            let triangles = in_order(&bvh.primitive_indices, &all);
            Box::new(Tree { bvh, triangles })
        }))
    }
}

impl Contender for Bvh2 {
    fn name(&self) -> &'static str {
        "obvhs bvh2"
    }

    fn build<'a>(
        &self,
        mesh: &'a TriangleMesh,
        workers: &Workers,
    ) -> Result<Box<dyn Built + 'a>, BenchError> {
        Ok(workers.run(|| {
            let all = triangles(mesh);
            let bvh = build_bvh2_from_tris(&all, PARAMS, &mut Duration::default());
            let triangles = in_order(&bvh.primitive_indices, &all);
            Box::new(Tree { bvh, triangles })
        }))
    }
}

fn triangles(mesh: &TriangleMesh) -> Vec<Triangle> {
    let triangle = |id| {
        let [v0, v1, v2] = mesh.corners(id).map(Into::into);
        Triangle { v0, v1, v2 }
    };
    (0..mesh.triangles().len() as u32).map(triangle).collect()
}

fn in_order(indices: &[u32], triangles: &[Triangle]) -> Vec<RtTriangle> {
    indices.iter().map(|&id| (&triangles[id as usize]).into()).collect()
}

fn ray(ray: &rays::Ray) -> Ray {
    Ray::new(ray.origin.into(), ray.direction.into(), 0.0, ray.t_max)
}

fn found(is_hit: bool, hit: &RayHit, indices: &[u32]) -> Found {
    match is_hit {
        true => Found { t: hit.t, id: indices[hit.primitive_id as usize] },
        false => Found::MISS,
    }
}

impl Built for Tree<obvhs::cwbvh::CwBvh> {
    fn prepare<'a>(&'a self, _kernel: &str, job: &Job<'_>) -> Option<Box<dyn Trace + 'a>> {
        let test = |ray: &Ray, id: usize| self.triangles[id].intersect(ray);
        let closest = move |ray: &Ray| {
            let mut hit = RayHit::none();
            let is_hit = self.bvh.ray_traverse(*ray, &mut hit, test);
            found(is_hit, &hit, &self.bvh.primitive_indices)
        };
        one_by_one(job, ray, closest, move |ray| !self.bvh.ray_traverse_miss(*ray, test))
    }
}

impl Built for Tree<obvhs::bvh2::Bvh2> {
    fn prepare<'a>(&'a self, _kernel: &str, job: &Job<'_>) -> Option<Box<dyn Trace + 'a>> {
        let test = |ray: &Ray, id: usize| self.triangles[id].intersect(ray);
        let closest = move |ray: &Ray| {
            let mut hit = RayHit::none();
            let is_hit = self.bvh.ray_traverse(*ray, &mut hit, test);
            found(is_hit, &hit, &self.bvh.primitive_indices)
        };
        one_by_one(job, ray, closest, move |ray| !self.bvh.ray_traverse_miss(*ray, test))
    }
}
