//! kdray itself.

use crate::contender::{Answers, Built, Contender, Found, Job, Trace, TreeBytes, one_by_one};
use crate::error::BenchError;
use crate::rays::{Question, RaySet, SetKind};
use crate::reference::exact_ray;
use crate::workers::Workers;
use kdray::build::Preset;
use kdray::geometry::Common;
use kdray::layout::WideTree;
use kdray::primitives::HitArrays;
use kdray::{
    Arithmetic, BuildOptions, CostModel, Hint, Hit, KdTree, Ray, RayPacket, Scene, ShapeScene,
    Strategy, TriangleMesh,
};
use std::ops::Range;

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
                "packets",
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
        if kernel == "packets" {
            return InPackets::new(scene, job.set).map(|trace| Box::new(trace) as Box<_>);
        }
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

/// Rays that are traced in packets.
struct InPackets {
    scene: Scene,
    /// What rays share: all, or each run of them.
    runs: Vec<(Common, Range<usize>)>,
    /// In what they differ.
    each: [Vec<f64>; 3],
    t_max: f64,
    hits: HitArrays,
}

/// Packets are handed over so many rays at a time, that their hits stay in the cache.
const RAYS_AT_ONCE: usize = 16384;

impl InPackets {
    /// `None` for rays that share nothing.
    fn new(scene: Scene, set: &RaySet) -> Option<Self> {
        let rays = &set.rays;
        let first = rays.first()?;
        let exactly = |v: [f32; 3]| v.map(f64::from);
        let whole = |common| vec![(common, 0..rays.len())];
        let (runs, differ): (_, fn(&crate::rays::Ray) -> [f32; 3]) = match set.kind {
            SetKind::Primary => (whole(Common::Origin(exactly(first.origin))), |it| it.direction),
            SetKind::Shadow => {
                let (o, d) = (exactly(first.origin), exactly(first.direction));
                let target = std::array::from_fn(|axis| o[axis] + d[axis]);
                (whole(Common::Target(target)), |it| it.origin)
            }
            SetKind::AoShared => {
                let mut runs = Vec::new();
                let mut begin = 0;
                for run in rays.chunk_by(|a, b| a.direction == b.direction) {
                    let common = Common::Direction(exactly(run[0].direction));
                    runs.push((common, begin..begin + run.len()));
                    begin += run.len();
                }
                (runs, |it| it.origin)
            }
            SetKind::Diffuse | SetKind::Ao => return None,
        };
        let column = |axis: usize| rays.iter().map(|ray| f64::from(differ(ray)[axis])).collect();
        let each = [column(0), column(1), column(2)];
        Some(Self { scene, runs, each, t_max: f64::from(first.t_max), hits: HitArrays::default() })
    }
}

impl Trace for InPackets {
    fn trace(&mut self, answers: &mut Answers) {
        let Self { scene, runs, each: [x, y, z], t_max, hits } = self;
        for (common, run) in runs {
            for begin in run.clone().step_by(RAYS_AT_ONCE) {
                let part = begin..(begin + RAYS_AT_ONCE).min(run.end);
                let each = [&x[part.clone()], &y[part.clone()], &z[part.clone()]];
                let packet = RayPacket::new(*common, each).with_interval(0.0, *t_max);
                match answers {
                    Answers::Any(answers) => {
                        scene.packet_any_hits(&packet, &mut answers[part]);
                    }
                    Answers::Closest(answers) => {
                        scene.packet_closest_hits(&packet, hits);
                        let numbers = hits.t().iter().zip(hits.primitive_id());
                        for (answer, (&t, &id)) in answers[part].iter_mut().zip(numbers) {
                            *answer = Found { t: t as f32, id };
                        }
                    }
                }
            }
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
