//! Building and tracing, with the clock running.
//!
//! Rays are timed by the processor time of the thread that traces them, which neither other programs
//! on the machine disturb nor threads that Embree keeps busy in its wait for work; wall time is
//! taken beside it. Contenders take turns in every round, so that a change of
//! the machine's speed meets all of them, and ratios are the median of the rounds' ratios.

use crate::contender::{Answers, Built, Contender, Job, Threads, Trace, TreeBytes, full_name};
use crate::contenders::{BASELINE, wanted};
use crate::error::BenchError;
use crate::memory;
use crate::rays::{RaySet, RaySets, SetKind};
use crate::reference::{Truth, Wrong};
use crate::report::{BuildRow, RayRow, TreesPerTriangle};
use crate::scene::BenchScene;
use crate::workers::Workers;
use cpu_time::{ProcessTime, ThreadTime};
use std::ops::Range;
use std::time::{Duration, Instant};

/// A sample has never fewer rays than one in this many.
const SMALLEST_SAMPLE: usize = 32;

/// Processor and wall time, in seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Took {
    pub(crate) cpu: f64,
    pub(crate) wall: f64,
}

/// What it takes to do `work` on this thread, and its result.
pub(crate) fn timed_here<R>(work: impl FnOnce() -> R) -> (R, Took) {
    let (cpu, wall) = (ThreadTime::now(), Instant::now());
    let result = work();
    let took = Took { cpu: cpu.elapsed().as_secs_f64(), wall: wall.elapsed().as_secs_f64() };
    (result, took)
}

/// What it takes to do `work` on all threads of the process, and its result.
pub(crate) fn timed<R>(work: impl FnOnce() -> R) -> (R, Took) {
    let (cpu, wall) = (ProcessTime::now(), Instant::now());
    let result = work();
    let took = Took { cpu: cpu.elapsed().as_secs_f64(), wall: wall.elapsed().as_secs_f64() };
    (result, took)
}

/// The middle value; of an even number the lower one of the two. Zero of none.
pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len().saturating_sub(1) / 2).copied().unwrap_or(0.0)
}

/// A contender with its structure over a scene.
pub(crate) struct Ready<'a> {
    contender: &'a dyn Contender,
    built: Box<dyn Built + 'a>,
}

/// Builds a contender's structure, `rounds` times, or until that took so many `seconds` in all.
pub(crate) fn build<'a>(
    contender: &'a dyn Contender,
    scene: &'a BenchScene,
    workers: &Workers,
    (rounds, seconds): (u32, f64),
) -> Result<(Ready<'a>, BuildRow), BenchError> {
    let (mut cpu, mut wall) = (Vec::new(), Vec::new());
    loop {
        let before = memory::in_use();
        let (built, took) = timed(|| contender.build(&scene.mesh, workers));
        let built = built?;
        cpu.push(took.cpu);
        wall.push(took.wall);
        if wall.len() < rounds as usize && wall.iter().sum::<f64>() < seconds {
            continue;
        }
        let rust = memory::in_use().saturating_sub(before);
        let bytes = built.own_bytes().unwrap_or(rust);
        let per_triangle = |bytes| bytes as f64 / scene.mesh.triangles().len().max(1) as f64;
        let TreeBytes { canonical, wide } = built.trees();
        let threads = match contender.builds_on() {
            Threads::Chosen => workers.count,
            Threads::One => 1,
            Threads::All => std::thread::available_parallelism().map_or(1, usize::from),
        };
        let row = BuildRow {
            scene: scene.name.clone(),
            contender: contender.name().to_owned(),
            threads,
            build_s: median(wall),
            build_cpu_s: median(cpu),
            bytes_per_triangle: per_triangle(bytes),
            trees: TreesPerTriangle {
                canonical: canonical.map(per_triangle),
                wide: wide.map(per_triangle),
            },
        };
        return Ok((Ready { contender, built }, row));
    }
}

/// What is asked of everyone.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Terms<'a> {
    /// Only of kernels whose names contain one of these; of all for none.
    pub(crate) names: &'a [String],
    /// How often everything is measured.
    pub(crate) rounds: u32,
    /// Whoever needs more seconds for a set traces a sample of its rays that takes about as long.
    pub(crate) longest_trace: f64,
}

/// A kernel with the rays of a set, or with a sample of them.
struct Lane<'a> {
    name: String,
    trace: Box<dyn Trace + 'a>,
    answers: Answers,
    /// Which rays of the set these are.
    runs: Vec<Range<usize>>,
    rays: usize,
    took: Vec<Took>,
}

/// How a kernel did on one set of rays.
pub(crate) struct Traced {
    pub(crate) row: RayRow,
    /// Rays a second in each round, by processor time.
    pub(crate) rates: Vec<f64>,
}

/// Measures all kernels that were asked for on one set of rays.
pub(crate) fn trace(
    ready: &[Ready<'_>],
    scene: &BenchScene,
    rays: &RaySets,
    (kind, truth): (SetKind, &Truth),
    terms: Terms<'_>,
) -> Vec<Traced> {
    let (set, primary) = (rays.set(kind), rays.set(SetKind::Primary));
    if set.rays.is_empty() {
        return Vec::new();
    }
    let mut lanes = Vec::new();
    for Ready { contender, built } in ready {
        for kernel in contender.kernels() {
            if wanted(*contender, kernel, terms.names) {
                let name = full_name(*contender, kernel);
                let prepare = |set: &RaySet| built.prepare(kernel, &Job { set, primary });
                lanes.extend(Lane::prepared_in_time(name, prepare, set, terms.longest_trace));
            }
        }
    }
    for _ in 0..terms.rounds {
        lanes.iter_mut().for_each(Lane::run);
    }
    let baseline = lanes.iter().position(|lane| lane.name == BASELINE);
    let baseline = baseline.map(|index| lanes[index].rates());
    let row = |lane: &Lane<'_>| {
        let wrong = lane.check(set, truth, scene.diagonal);
        Traced { row: lane.row(scene, kind, baseline.as_deref(), wrong), rates: lane.rates() }
    };
    lanes.iter().map(row).collect()
}

impl<'a> Lane<'a> {
    /// Prepares all rays of a set, or else as many as can be traced in time.
    fn prepared_in_time(
        name: String,
        prepare: impl Fn(&RaySet) -> Option<Box<dyn Trace + 'a>>,
        set: &RaySet,
        longest: f64,
    ) -> Option<Self> {
        let all = set.rays.len();
        let runs = set.sample_runs(all / 64);
        let pilot = set.sample(&runs);
        let mut lane = Self::prepared(name, prepare(&pilot)?, &pilot, runs);
        // The first time warms the caches.
        lane.run();
        lane.run();
        let seconds = lane.took[1].cpu * all as f64 / lane.rays as f64;
        let share = (longest / seconds.max(longest)).max(1.0 / SMALLEST_SAMPLE as f64);
        let runs = set.sample_runs((all as f64 * share) as usize);
        let set = set.sample(&runs);
        Some(Self::prepared(lane.name, prepare(&set)?, &set, runs))
    }

    fn prepared(
        name: String,
        trace: Box<dyn Trace + 'a>,
        set: &RaySet,
        runs: Vec<Range<usize>>,
    ) -> Self {
        let rays = set.rays.len();
        let answers = Answers::room(set.kind.question(), rays);
        Self { name, trace, answers, runs, rays, took: Vec::new() }
    }

    /// Counts the wrong ones among the answers of the last round.
    fn check(&self, set: &RaySet, truth: &Truth, diagonal: f64) -> Wrong {
        let rays = set.sample(&self.runs).rays;
        truth.sample(&self.runs).check(&self.answers, &rays, diagonal)
    }

    fn run(&mut self) {
        let ((), took) = timed_here(|| self.trace.trace(&mut self.answers));
        self.took.push(took);
    }

    /// Rays a second in each round, by processor time.
    fn rates(&self) -> Vec<f64> {
        self.took.iter().map(|took| self.rays as f64 / took.cpu).collect()
    }

    fn row(
        &self,
        scene: &BenchScene,
        kind: SetKind,
        baseline: Option<&[f64]>,
        wrong: Wrong,
    ) -> RayRow {
        let rates = self.rates();
        let ratio =
            |base: &[f64]| median(rates.iter().zip(base).map(|(rate, base)| rate / base).collect());
        RayRow {
            scene: scene.name.clone(),
            set: kind.name().to_owned(),
            contender: self.name.clone(),
            best: None,
            rays: self.rays,
            mrays_wall: self.rays as f64
                / median(self.took.iter().map(|it| it.wall).collect())
                / 1e6,
            ratio: baseline.map(ratio),
            mrays: median(rates) / 1e6,
            wrong,
        }
    }
}

/// The time as people say it.
pub(crate) fn spoken(took: Duration) -> String {
    let seconds = took.as_secs();
    if seconds < 60 {
        return format!("{:.1} s", took.as_secs_f64());
    }
    format!("{} min {} s", seconds / 60, seconds % 60)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contender::Found;
    use crate::rays;

    #[test]
    fn medians_are_values_that_were_measured() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(vec![4.0, 1.0, 3.0, 2.0]), 2.0);
        assert_eq!(median(Vec::new()), 0.0);
    }

    /// Answers every ray with the same hit.
    struct Always(f32);

    impl Trace for Always {
        fn trace(&mut self, answers: &mut Answers) {
            if let Answers::Closest(found) = answers {
                found.fill(Found { t: self.0, id: 1 });
            }
        }
    }

    #[test]
    fn wrong_answers_are_counted_in_a_lane() {
        let (scene, reference, sets) = rays::tests::terrain();
        let set = sets.set(SetKind::Primary);
        let truth = reference.truth(set);
        let hits = reference.hits(&set.rays).iter().flatten().count();
        let lane = |t| {
            let prepare = move |_: &RaySet| Some(Box::new(Always(t)) as Box<dyn Trace>);
            let mut lane = Lane::prepared_in_time("liar".into(), prepare, set, 1.0).unwrap();
            lane.run();
            lane.check(set, &truth, scene.diagonal)
        };
        let wrong = lane(1e6);
        assert_eq!(wrong.phantom as usize, set.rays.len() - hits);
        assert_eq!((wrong.far as usize, wrong.lost), (hits, 0));
    }

    #[test]
    fn times_are_spoken() {
        assert_eq!(spoken(Duration::from_millis(1500)), "1.5 s");
        assert_eq!(spoken(Duration::from_secs(125)), "2 min 5 s");
    }
}
