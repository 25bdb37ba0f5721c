//! The crate kdtree-ray: a SAH kd-tree that lists, for a ray, all shapes of all leaves it passes.
//!
//! It neither knows rays' ends nor stops at a hit. It brings no triangle test; ours is used.

use super::triangle::{TestRay, Triangle};
use crate::contender::{Built, Contender, Found, Job, Threads, Trace, one_by_one};
use crate::error::BenchError;
use crate::rays;
use crate::workers::Workers;
use cgmath::Vector3;
use kdray::TriangleMesh;
use kdtree_ray::{AABB, Bounded, KDTree};

/// The crate.
pub(super) struct KdTreeRay;

struct Tree {
    tree: KDTree,
    triangles: Vec<Triangle>,
}

/// A triangle's box, all that a build needs.
struct Shape(AABB);

impl Bounded for Shape {
    fn bound(&self) -> AABB {
        self.0.clone()
    }
}

impl Contender for KdTreeRay {
    fn name(&self) -> &'static str {
        "kdtree-ray"
    }

    fn builds_on(&self) -> Threads {
        Threads::All
    }

    fn build<'a>(
        &self,
        mesh: &'a TriangleMesh,
        _workers: &Workers,
    ) -> Result<Box<dyn Built + 'a>, BenchError> {
        let ids = 0..mesh.triangles().len() as u32;
        if ids.is_empty() {
            return Err(BenchError::Contender("kdtree-ray takes no empty meshes".to_owned()));
        }
        let shapes: Vec<Shape> = ids.clone().map(|id| Shape(bounds(mesh.corners(id)))).collect();
        let tree = KDTree::build(&shapes);
        let triangles = ids.map(|id| Triangle::new(mesh.corners(id))).collect();
        Ok(Box::new(Tree { tree, triangles }))
    }
}

fn bounds(corners: [[f32; 3]; 3]) -> AABB {
    let [a, b, c] = corners;
    let least = |axis: usize| a[axis].min(b[axis]).min(c[axis]);
    let greatest = |axis: usize| a[axis].max(b[axis]).max(c[axis]);
    let point = |x: [f32; 3]| Vector3::new(x[0], x[1], x[2]);
    AABB::new(point([0, 1, 2].map(least)), point([0, 1, 2].map(greatest)))
}

/// A ray as the crate and the triangle test take it.
struct BothRays {
    origin: Vector3<f32>,
    direction: Vector3<f32>,
    test: TestRay,
    t_max: f32,
}

impl BothRays {
    fn new(ray: &rays::Ray) -> Self {
        let (origin, direction) = (ray.origin.into(), ray.direction.into());
        Self { origin, direction, test: TestRay::new(ray), t_max: ray.t_max }
    }
}

impl Tree {
    fn closest(&self, ray: &BothRays) -> Found {
        let mut found = Found { t: ray.t_max, ..Found::MISS };
        for id in self.tree.intersect(&ray.origin, &ray.direction) {
            if let Some(t) = self.triangles[id].hit(&ray.test, found.t) {
                found = Found { t, id: id as u32 };
            }
        }
        found
    }

    fn any(&self, ray: &BothRays) -> bool {
        let candidates = self.tree.intersect(&ray.origin, &ray.direction);
        candidates.iter().any(|&id| self.triangles[id].hit(&ray.test, ray.t_max).is_some())
    }
}

impl Built for Tree {
    fn prepare<'a>(&'a self, _kernel: &str, job: &Job<'_>) -> Option<Box<dyn Trace + 'a>> {
        one_by_one(job, BothRays::new, |ray| self.closest(ray), |ray| self.any(ray))
    }
}
