//! The comparison, scene by scene.

use crate::args::Compare;
use crate::contender::{Contender, Threads};
use crate::contenders;
use crate::embree::Embree;
use crate::error::BenchError;
use crate::machine::{Machine, work_folder};
use crate::measure::{self, Ready, Terms, spoken};
use crate::packets;
use crate::rays::{RaySets, SetKind};
use crate::reference::Reference;
use crate::report::{BuildRow, Outputs, Report, say};
use crate::scene::BenchScene;
use crate::workers::Workers;
use std::time::Instant;

/// Rays through so many pixels across and down.
const RESOLUTION: u32 = 1024;
const RESOLUTION_QUICK: u32 = 512;

/// How often everything is measured.
pub(crate) const ROUNDS: u32 = 5;
const ROUNDS_QUICK: u32 = 3;

/// How many seconds a kernel may need for a set before it traces only a sample.
pub(crate) const LONGEST_TRACE: f64 = 0.4;
const LONGEST_TRACE_QUICK: f64 = 0.2;

/// Builds are repeated until they took so many seconds in all.
const BUILDS: f64 = 0.6;

/// What is the same for all scenes.
struct Run<'a> {
    options: &'a Compare,
    contenders: Vec<Box<dyn Contender>>,
    sets: Vec<SetKind>,
    resolution: u32,
    rounds: u32,
}

/// Embree, or a line that says why not.
pub(crate) fn embree() -> Option<Embree> {
    match Embree::fetch(&work_folder()) {
        Ok(embree) => Some(embree),
        Err(error) => {
            say(&format!("{error}\ngoing on without Embree; there are no ratios"));
            None
        }
    }
}

/// Runs the comparison and tells it.
pub(crate) fn run(options: &Compare) -> Result<(), BenchError> {
    let start = Instant::now();
    let outputs = Outputs::create(options)?;
    let sets = SetKind::of_names(&options.sets)?;
    let embree = embree();
    let version = embree.as_ref().map(Embree::version).transpose()?;
    let run = Run {
        options,
        contenders: chosen(embree.as_ref(), &options.contenders)?,
        sets,
        resolution: options.resolution.unwrap_or(if options.quick {
            RESOLUTION_QUICK
        } else {
            RESOLUTION
        }),
        rounds: options.rounds.unwrap_or(if options.quick { ROUNDS_QUICK } else { ROUNDS }),
    };
    let mut report = Report::new(Machine::here(version), run.resolution, run.rounds);
    for name in scenes(options) {
        run.scene(&BenchScene::find(&name, &options.view)?, &mut report)?;
    }
    report.seconds = start.elapsed().as_secs_f64();
    outputs.write(&report)?;
    say(&format!("done in {}", spoken(start.elapsed())));
    Ok(())
}

/// The contenders of which some kernel was asked for.
pub(crate) fn chosen(
    embree: Option<&Embree>,
    names: &[String],
) -> Result<Vec<Box<dyn Contender>>, BenchError> {
    let mut list = contenders::all(embree);
    list.retain(|it| {
        it.kernels().iter().any(|kernel| contenders::wanted(it.as_ref(), kernel, names))
    });
    if list.is_empty() {
        return Err(BenchError::Usage(format!("no contender is called {}", names.join(", "))));
    }
    Ok(list)
}

/// The names of the scenes to run.
fn scenes(options: &Compare) -> Vec<String> {
    if !options.scenes.is_empty() {
        return options.scenes.clone();
    }
    if !BenchScene::has_shared() {
        say("there is no folder ../shared/scenes beside the checkout: scenes are made by code");
    }
    BenchScene::default_names(options.quick)
}

impl Run<'_> {
    fn scene(&self, scene: &BenchScene, report: &mut Report) -> Result<(), BenchError> {
        let start = Instant::now();
        let triangles = scene.mesh.triangles().len();
        say(&format!("{}: {triangles} triangles", scene.name));
        let reference = Reference::build(&scene.mesh)?;
        let folder = work_folder().join("rays");
        let rays = RaySets::get(scene, &reference, self.resolution, &folder)?;
        let truths = self.sets.iter().map(|&kind| (kind, reference.truth(rays.set(kind))));
        let truths: Vec<_> = truths.collect();
        drop(reference);
        say(&format!("  rays and exact answers: {}", spoken(start.elapsed())));
        let ready = self.build_all(scene, &mut report.builds)?;
        for (kind, truth) in &truths {
            let start = Instant::now();
            let traced = measure::trace(&ready, scene, &rays, (*kind, truth), self.terms());
            let names = &self.options.contenders;
            let best = packets::best_row(&traced, *kind, names);
            report.packets.extend(packets::packet_row(&traced, *kind, names));
            report.rays.extend(traced.into_iter().map(|it| it.row).chain(best));
            let count = rays.set(*kind).rays.len();
            say(&format!("  {}: {count} rays, {}", kind.name(), spoken(start.elapsed())));
        }
        report.scenes.push((scene.name.clone(), triangles));
        Ok(())
    }

    fn terms(&self) -> Terms<'_> {
        let quick = self.options.quick;
        Terms {
            names: &self.options.contenders,
            rounds: self.rounds,
            longest_trace: if quick { LONGEST_TRACE_QUICK } else { LONGEST_TRACE },
        }
    }

    /// Builds all structures on the first number of threads, to be kept, and on the others only to
    /// know the time.
    fn build_all<'a>(
        &'a self,
        scene: &'a BenchScene,
        rows: &mut Vec<BuildRow>,
    ) -> Result<Vec<Ready<'a>>, BenchError> {
        let workers = self.options.thread_counts().into_iter().map(Workers::new);
        let workers: Vec<Workers> = workers.collect::<Result<_, _>>()?;
        let mut ready = Vec::new();
        for contender in &self.contenders {
            let contender = contender.as_ref();
            let start = Instant::now();
            let has_choice = contender.builds_on() == Threads::Chosen;
            let mut kept = None;
            for workers in &workers[..if has_choice { workers.len() } else { 1 }] {
                let (built, row) =
                    measure::build(contender, scene, workers, (self.rounds, BUILDS))?;
                kept = kept.or(Some(built));
                rows.push(row);
            }
            ready.extend(kept);
            let bytes = rows.last().map_or(0.0, |row| row.bytes_per_triangle);
            let took = spoken(start.elapsed());
            say(&format!("  built {} in {took}, {bytes:.0} B a triangle", contender.name()));
        }
        Ok(ready)
    }
}
