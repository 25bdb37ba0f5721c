//! The crate bvh: a binary BVH by binned SAH, whose iterators yield shapes by the distance of their
//! boxes.
//!
//! Its own triangle test passes over back faces, so ours is used.

use super::triangle::{TestRay, Triangle};
use crate::contender::{Built, Contender, Found, Job, Trace, one_by_one};
use crate::error::BenchError;
use crate::rays;
use crate::workers::Workers;
use bvh::aabb::{Aabb, Bounded};
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::{Bvh as Hierarchy, rayon_executor};
use bvh::ray::Ray;
use kdray::TriangleMesh;

/// The crate.
pub(super) struct Bvh;

/// A triangle as the crate wants it.
struct Shape {
    bounds: Aabb<f32, 3>,
    triangle: Triangle,
    node: usize,
    id: u32,
}

impl Bounded<f32, 3> for Shape {
    fn aabb(&self) -> Aabb<f32, 3> {
        self.bounds
    }
}

impl BHShape<f32, 3> for Shape {
    fn set_bh_node_index(&mut self, index: usize) {
        self.node = index;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

/// The tree and its shapes.
struct Tree {
    hierarchy: Hierarchy<f32, 3>,
    shapes: Vec<Shape>,
}

impl Contender for Bvh {
    fn name(&self) -> &'static str {
        "bvh"
    }

    fn build<'a>(
        &self,
        mesh: &'a TriangleMesh,
        workers: &Workers,
    ) -> Result<Box<dyn Built + 'a>, BenchError> {
        Ok(workers.run(|| {
            let count = mesh.triangles().len() as u32;
            let mut shapes: Vec<Shape> = (0..count).map(|id| shape(mesh, id)).collect();
            let hierarchy = match workers.count {
                1 => Hierarchy::build(&mut shapes),
                _ => Hierarchy::build_with_executor(&mut shapes, rayon_executor),
            };
            Box::new(Tree { hierarchy, shapes })
        }))
    }
}

fn shape(mesh: &TriangleMesh, id: u32) -> Shape {
    let corners = mesh.corners(id);
    let mut bounds = Aabb::empty();
    for corner in corners {
        bounds.grow_mut(&corner.into());
    }
    Shape { bounds, triangle: Triangle::new(corners), node: 0, id }
}

/// A ray as the crate and the triangle test take it. The direction keeps its length.
struct BothRays {
    ray: Ray<f32, 3>,
    test: TestRay,
    t_max: f32,
}

impl BothRays {
    fn new(ray: &rays::Ray) -> Self {
        let direction = nalgebra::Vector3::from(ray.direction);
        let inv_direction = direction.map(|x| 1.0 / x);
        let test = TestRay::new(ray);
        let (origin, t_max) = (ray.origin.into(), ray.t_max);
        Self { ray: Ray { origin, direction, inv_direction }, test, t_max }
    }
}

impl Tree {
    fn closest(&self, ray: &BothRays) -> Found {
        let mut found = Found { t: ray.t_max, ..Found::MISS };
        for shape in self.hierarchy.nearest_traverse_iterator(&ray.ray, &self.shapes) {
            // Boxes come by rising distance: the first one behind the best hit ends the ray.
            let entry = ray.ray.intersection_slice_for_aabb(&shape.bounds);
            if entry.is_some_and(|(t, _)| t > found.t) {
                break;
            }
            if let Some(t) = shape.triangle.hit(&ray.test, found.t) {
                found = Found { t, id: shape.id };
            }
        }
        found
    }

    fn any(&self, ray: &BothRays) -> bool {
        for shape in self.hierarchy.nearest_traverse_iterator(&ray.ray, &self.shapes) {
            let entry = ray.ray.intersection_slice_for_aabb(&shape.bounds);
            if entry.is_some_and(|(t, _)| t > ray.t_max) {
                return false;
            }
            if shape.triangle.hit(&ray.test, ray.t_max).is_some() {
                return true;
            }
        }
        false
    }
}

impl Built for Tree {
    fn prepare<'a>(&'a self, _kernel: &str, job: &Job<'_>) -> Option<Box<dyn Trace + 'a>> {
        one_by_one(job, BothRays::new, |ray| self.closest(ray), |ray| self.any(ray))
    }
}
