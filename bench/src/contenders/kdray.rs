//! kdray itself.

use crate::contender::{Answers, Built, Contender, Found, Job, Trace, TreeBytes, one_by_one};
use crate::error::BenchError;
use crate::rays::Question;
use crate::reference::exact_ray;
use crate::workers::Workers;
use kdray::build::Preset;
use kdray::layout::WideTree;
use kdray::{
    Arithmetic, BuildOptions, CostModel, Hint, Hit, KdTree, Ray, Scene, ShapeScene, Strategy,
    TriangleMesh,
};

/// All of kdray's structures.
pub(super) fn all() -> Vec<Box<dyn Contender>> {
    vec![
        Box::new(Kdray { name: "kdray", preset: Preset::Balanced }),
        Box::new(Kdray { name: "kdray fast", preset: Preset::Fast }),
        Box::new(Kdray { name: "kdray best", preset: Preset::Best }),
        Box::new(Lecture),
    ]
}

/// A scene by a preset: the canonical tree and the wide one.
struct Kdray {
    name: &'static str,
    preset: Preset,
}

impl Contender for Kdray {
    fn name(&self) -> &'static str {
        self.name
    }

    fn kernels(&self) -> &'static [&'static str] {
        match self.preset {
            Preset::Balanced => &[
                "single",
                "batch",
                "hint",
                "batch hint",
                "single float",
                "batch float",
                "hint float",
                "batch hint float",
            ],
            _ => &["single", "batch"],
        }
    }

    fn build<'a>(
        &self,
        mesh: &'a TriangleMesh,
        workers: &Workers,
    ) -> Result<Box<dyn Built + 'a>, BenchError> {
        let mesh = mesh.clone();
        let scene = workers.run(|| Scene::build(mesh, &BuildOptions::preset(self.preset)))?;
        Ok(Box::new(BuiltKdray { scene }))
    }
}

struct BuiltKdray {
    scene: Scene,
}

impl Built for BuiltKdray {
    fn trees(&self) -> TreeBytes {
        let wide = self.scene.wide_tree().map(WideTree::bytes);
        TreeBytes { canonical: Some(bytes(self.scene.tree())), wide }
    }

    fn prepare<'a>(&'a self, kernel: &str, job: &Job<'_>) -> Option<Box<dyn Trace + 'a>> {
        let scene = self.scene.clone();
        let (kernel, scene) = match kernel.strip_suffix(" float") {
            Some(kernel) => (kernel, scene.with_arithmetic(Arithmetic::Float)),
            None => (kernel, scene),
        };
        if kernel == "batch" {
            let rays = job.set.rays.iter().map(exact_ray).collect();
            return Some(Box::new(InBatches { scene, rays }));
        }
        if let "hint" | "batch hint" = kernel {
            return WithHints::new(scene, job, kernel == "batch hint")
                .map(|trace| Box::new(trace) as Box<_>);
        }
        let for_any = scene.clone();
        let closest = move |ray: &Ray| found(scene.closest_hit(ray));
        one_by_one(job, exact_ray, closest, move |ray| for_any.any_hit(ray))
    }
}

/// Rays that are traced many at a time.
struct InBatches {
    scene: Scene,
    rays: Vec<Ray>,
}

impl Trace for InBatches {
    fn trace(&mut self, answers: &mut Answers) {
        match answers {
            Answers::Closest(answers) => {
                self.scene.each_closest_hit(&self.rays, |index, hit| answers[index] = found(hit));
            }
            Answers::Any(answers) => self.scene.any_hits(&self.rays, answers),
        }
    }
}

/// Rays that are traced one by one or in batches, each from where its parent hit.
struct WithHints {
    scene: Scene,
    rays: Vec<Ray>,
    hints: Vec<Hint>,
    in_batches: bool,
}

impl WithHints {
    /// Finds the hints; `None` for rays that do not ask for any hit, or have no parents.
    fn new(scene: Scene, job: &Job<'_>, in_batches: bool) -> Option<Self> {
        let set = job.set;
        if set.kind.question() != Question::Any || set.parents.is_empty() {
            return None;
        }
        let hint = |&parent: &u32| {
            let parent = exact_ray(&job.primary.rays[parent as usize]);
            scene.closest_hit_with_hint(&parent).map_or(Hint::NONE, |(_, hint)| hint)
        };
        let rays = set.rays.iter().map(exact_ray).collect();
        let hints = set.parents.iter().map(hint).collect();
        Some(Self { scene, rays, hints, in_batches })
    }
}

impl Trace for WithHints {
    fn trace(&mut self, answers: &mut Answers) {
        let Answers::Any(answers) = answers else { return };
        if self.in_batches {
            return self.scene.any_hits_near(&self.rays, &self.hints, answers);
        }
        for (answer, (ray, hint)) in answers.iter_mut().zip(self.rays.iter().zip(&self.hints)) {
            *answer = self.scene.any_hit_near(ray, *hint);
        }
    }
}

/// The tree of the lecture, by the surface area heuristic, and the scalar traversal, exact.
struct Lecture;

impl Contender for Lecture {
    fn name(&self) -> &'static str {
        "kdray lecture"
    }

    fn build<'a>(
        &self,
        mesh: &'a TriangleMesh,
        workers: &Workers,
    ) -> Result<Box<dyn Built + 'a>, BenchError> {
        let (mesh, options) = (mesh.clone(), BuildOptions::for_strategy(Strategy::Sah));
        Ok(Box::new(BuiltLecture { scene: workers.run(|| ShapeScene::build(mesh, &options))? }))
    }
}

struct BuiltLecture {
    scene: ShapeScene,
}

impl Built for BuiltLecture {
    fn trees(&self) -> TreeBytes {
        TreeBytes { canonical: Some(bytes(self.scene.tree())), wide: None }
    }

    fn prepare<'a>(&'a self, _kernel: &str, job: &Job<'_>) -> Option<Box<dyn Trace + 'a>> {
        one_by_one(
            job,
            exact_ray,
            |ray| found(self.scene.closest_hit(ray)),
            |ray| self.scene.any_hit(ray),
        )
    }
}

/// How much memory the canonical tree takes.
fn bytes(tree: &KdTree) -> usize {
    // Neither the number of triangles nor the cost has to do with it.
    tree.stats(0, &CostModel::default()).bytes
}

fn found(hit: Option<Hit>) -> Found {
    hit.map_or(Found::MISS, |hit| Found { t: hit.t as f32, id: hit.primitive_id })
}
