//! Embree 4: three kinds of scenes, each with single rays and packets of eight.

use crate::contender::{Answers, Built, Contender, Found, Job, Trace, one_by_one};
use crate::embree::{Embree, Hint, Packet, Quality, Scene, SingleRay};
use crate::error::BenchError;
use crate::workers::Workers;
use kdray::TriangleMesh;

/// Scenes of all kinds.
pub(super) fn all(library: &Embree) -> Vec<Box<dyn Contender>> {
    let kinds = [
        ("embree medium", Quality::Medium),
        ("embree high", Quality::High),
        ("embree robust", Quality::Robust),
    ];
    let contender = |(name, quality)| {
        Box::new(EmbreeScene { library: library.clone(), name, quality }) as Box<dyn Contender>
    };
    kinds.map(contender).into()
}

struct EmbreeScene {
    library: Embree,
    name: &'static str,
    quality: Quality,
}

impl Contender for EmbreeScene {
    fn name(&self) -> &'static str {
        self.name
    }

    fn kernels(&self) -> &'static [&'static str] {
        &["single", "8", "8 coherent"]
    }

    fn build<'a>(
        &self,
        mesh: &'a TriangleMesh,
        workers: &Workers,
    ) -> Result<Box<dyn Built + 'a>, BenchError> {
        let scene = self.library.scene(mesh, self.quality, workers.count)?;
        Ok(Box::new(BuiltScene { scene }))
    }
}

struct BuiltScene {
    scene: Scene,
}

impl Built for BuiltScene {
    fn own_bytes(&self) -> Option<usize> {
        Some(self.scene.bytes())
    }

    fn prepare<'a>(&'a self, kernel: &str, job: &Job<'_>) -> Option<Box<dyn Trace + 'a>> {
        let scene = &self.scene;
        let hint = match kernel {
            "single" => {
                return one_by_one(
                    job,
                    |ray| SingleRay::new(ray.origin, ray.direction, ray.t_max),
                    |ray| match scene.closest(ray) {
                        Some((t, id)) => Found { t, id },
                        None => Found::MISS,
                    },
                    |ray| scene.any(ray),
                );
            }
            "8" => Hint::Incoherent,
            _ => Hint::Coherent,
        };
        let single = |ray: &crate::rays::Ray| (ray.origin, ray.direction, ray.t_max);
        let packets = job.set.rays.chunks(8);
        let packets = packets.map(|rays| Packet::new(rays.iter().map(single))).collect();
        Some(Box::new(Packets { scene, packets, hint }))
    }
}

/// Rays in packets of eight; the last one may have fewer.
struct Packets<'a> {
    scene: &'a Scene,
    packets: Vec<Packet>,
    hint: Hint,
}

impl Trace for Packets<'_> {
    fn trace(&mut self, answers: &mut Answers) {
        match answers {
            Answers::Closest(found) => {
                for (found, packet) in found.chunks_mut(8).zip(&self.packets) {
                    let (t, id) = self.scene.closest8(packet, self.hint);
                    for ((found, t), id) in found.iter_mut().zip(t).zip(id) {
                        *found = if id == u32::MAX { Found::MISS } else { Found { t, id } };
                    }
                }
            }
            Answers::Any(found) => {
                for (found, packet) in found.chunks_mut(8).zip(&self.packets) {
                    let any = self.scene.any8(packet, self.hint);
                    found.iter_mut().zip(any).for_each(|(found, any)| *found = any);
                }
            }
        }
    }
}
