//! kdray itself.

use crate::contender::{Built, Contender, Found, Job, Trace, one_by_one};
use crate::error::BenchError;
use crate::reference::exact_ray;
use crate::workers::Workers;
use kdray::{Arithmetic, BuildOptions, Hit, Scene, TriangleMesh};

/// All of kdray's structures.
pub(super) fn all() -> Vec<Box<dyn Contender>> {
    vec![Box::new(Kdray)]
}

/// What a scene builds by default: the canonical tree and the wide one.
struct Kdray;

impl Contender for Kdray {
    fn name(&self) -> &'static str {
        "kdray"
    }

    fn kernels(&self) -> &'static [&'static str] {
        &["single", "single float", "scalar"]
    }

    fn build<'a>(
        &self,
        mesh: &'a TriangleMesh,
        workers: &Workers,
    ) -> Result<Box<dyn Built + 'a>, BenchError> {
        let mesh = mesh.clone();
        let exact = workers.run(|| Scene::build(mesh, &options()))?;
        Ok(Box::new(BuiltKdray { exact }))
    }
}

fn options() -> BuildOptions {
    let mut options = BuildOptions::default();
    options.cost = kdray::CostModel::BLOCKS_OF_8;
    options.prune = true;
    options.sah_builder = kdray::build::SahBuilder::Binned { sweep_below: 64 };
    options
}

struct BuiltKdray {
    exact: Scene,
}

impl Built for BuiltKdray {
    fn prepare<'a>(&'a self, kernel: &str, job: &Job<'_>) -> Option<Box<dyn Trace + 'a>> {
        match kernel {
            "single" => single(&self.exact, job),
            "single float" => {
                let float = self.exact.clone().with_arithmetic(Arithmetic::Float);
                let float = std::rc::Rc::new(float);
                let other = std::rc::Rc::clone(&float);
                one_by_one(
                    job,
                    exact_ray,
                    move |ray| found(float.closest_hit(ray)),
                    move |ray| other.any_hit(ray),
                )
            }
            _ => {
                let shapes = self.exact.shapes();
                one_by_one(
                    job,
                    exact_ray,
                    |ray| found(shapes.closest_hit(ray)),
                    |ray| shapes.any_hit(ray),
                )
            }
        }
    }
}

fn single<'a>(scene: &'a Scene, job: &Job<'_>) -> Option<Box<dyn Trace + 'a>> {
    one_by_one(job, exact_ray, |ray| found(scene.closest_hit(ray)), |ray| scene.any_hit(ray))
}

fn found(hit: Option<Hit>) -> Found {
    hit.map_or(Found::MISS, |hit| Found { t: hit.t as f32, id: hit.primitive_id })
}
