//! parry3d's triangle mesh, as physics engines use it.

use crate::contender::{Built, Contender, Found, Job, Threads, Trace, one_by_one};
use crate::error::BenchError;
use crate::rays;
use crate::workers::Workers;
use kdray::TriangleMesh;
use parry3d::math::Vector;
use parry3d::query::{Ray, RayCast};
use parry3d::shape::{CompositeShapeRef, TriMesh};

/// The crate.
pub(super) struct Parry;

struct Tree {
    mesh: TriMesh,
}

impl Contender for Parry {
    fn name(&self) -> &'static str {
        "parry3d"
    }

    fn builds_on(&self) -> Threads {
        Threads::One
    }

    fn has_any_hit(&self) -> bool {
        false
    }

    fn build<'a>(
        &self,
        mesh: &'a TriangleMesh,
        _workers: &Workers,
    ) -> Result<Box<dyn Built + 'a>, BenchError> {
        let vertices = mesh.vertices().iter().map(|&vertex| Vector::from(vertex)).collect();
        let made = TriMesh::new(vertices, mesh.triangles().to_vec());
        let mesh = made.map_err(|error| BenchError::Contender(format!("parry3d: {error}")))?;
        Ok(Box::new(Tree { mesh }))
    }
}

/// A ray and its end, which is finite.
fn ray(ray: &rays::Ray) -> (Ray, f32) {
    (Ray::new(ray.origin.into(), ray.direction.into()), ray.t_max.min(f32::MAX))
}

impl Tree {
    fn closest(&self, (ray, t_max): &(Ray, f32)) -> Found {
        let hit = CompositeShapeRef(&self.mesh).cast_local_ray(ray, *t_max, false);
        hit.map_or(Found::MISS, |(id, t)| Found { t, id })
    }

    /// The crate has no such query. A first hit that is said to be at zero ends its search for the
    /// closest one.
    fn any(&self, (ray, t_max): &(Ray, f32)) -> bool {
        let hit = |id, t_max| {
            let hit = self.mesh.triangle(id).cast_local_ray(ray, t_max, false);
            hit.map(|_| 0.0)
        };
        self.mesh.bvh().cast_ray(ray, *t_max, hit).is_some()
    }
}

impl Built for Tree {
    fn prepare<'a>(&'a self, _kernel: &str, job: &Job<'_>) -> Option<Box<dyn Trace + 'a>> {
        one_by_one(job, ray, |ray| self.closest(ray), |ray| self.any(ray))
    }
}
