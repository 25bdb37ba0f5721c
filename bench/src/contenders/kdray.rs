//! kdray itself.

use crate::contender::{Built, Contender, Found, Job, Trace, one_by_one};
use crate::error::BenchError;
use crate::reference::exact_ray;
use crate::workers::Workers;
use kdray::{BuildOptions, Hit, Scene, TriangleMesh};

/// All of kdray's structures.
pub(super) fn all() -> Vec<Box<dyn Contender>> {
    vec![Box::new(Scalar)]
}

/// The canonical tree and the scalar traversal, exact.
struct Scalar;

impl Contender for Scalar {
    fn name(&self) -> &'static str {
        "kdray"
    }

    fn kernels(&self) -> &'static [&'static str] {
        &["scalar"]
    }

    fn build<'a>(
        &self,
        mesh: &'a TriangleMesh,
        workers: &Workers,
    ) -> Result<Box<dyn Built + 'a>, BenchError> {
        let mesh = mesh.clone();
        let scene = workers.run(|| Scene::build(mesh, &BuildOptions::default()))?;
        Ok(Box::new(BuiltScalar { scene }))
    }
}

struct BuiltScalar {
    scene: Scene,
}

impl Built for BuiltScalar {
    fn prepare<'a>(&'a self, _kernel: &str, job: &Job<'_>) -> Option<Box<dyn Trace + 'a>> {
        one_by_one(
            job,
            exact_ray,
            |ray| found(self.scene.closest_hit(ray)),
            |ray| self.scene.any_hit(ray),
        )
    }
}

fn found(hit: Option<Hit>) -> Found {
    hit.map_or(Found::MISS, |hit| Found { t: hit.t as f32, id: hit.primitive_id })
}
