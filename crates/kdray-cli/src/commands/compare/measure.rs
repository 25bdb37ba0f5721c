//! Asking all rays of all contenders: answers, counts and times.

use super::Contender;
use super::contender::Kind;
use super::counted::Counted;
use super::rays::{RaySet, RaySets};
use crate::{cli::Globals, error::CliError, interrupt, progress::Progress};
use kdray::{
    Aabb, Hit, Ray, ShapeScene, TriangleMesh,
    primitives::Primitives,
    traverse::{Counters, Naive},
};
use rayon::{ThreadPool, prelude::*};
use std::{hint::black_box, time::Instant};

/// About how many triangle tests the naive answer may cost a set of rays in all.
const NAIVE_TESTS: usize = 60_000_000;

/// What a contender did with one set of rays.
#[derive(Clone, Debug, Default)]
pub(super) struct Figures {
    /// What the set is called.
    pub(super) set: &'static str,
    /// How many rays it answered; the naive one only some, spread evenly over the set.
    pub(super) rays: usize,
    /// Every so manieth ray was answered.
    pub(super) stride: usize,
    /// What it cost.
    pub(super) counters: Counters,
    /// The median of the rounds' times, in seconds.
    pub(super) seconds: f64,
    answers: Vec<Answer>,
}

/// What was found.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Answer {
    Closest(Option<Hit>),
    Any(bool),
}

/// Fills in the figures of all contenders, who work on the threads of `pool`.
pub(super) fn measure(
    contenders: &mut [Contender<'_>],
    rays: &RaySets,
    rounds: u32,
    pool: &ThreadPool,
    globals: &Globals,
) -> Result<(), CliError> {
    let (sets, count) = (rays.sets.len(), contenders.len());
    let steps = (u64::from(rounds) + 1) * (sets * count) as u64;
    let progress = Progress::start("measuring", steps, "sets of rays", globals);
    let step = || {
        progress.advance(1);
        if interrupt::requested() { Err(CliError::Interrupted) } else { Ok(()) }
    };
    let _watch = interrupt::watch();
    // Answers and counts first, which also warms the caches.
    for contender in &mut *contenders {
        for set in &rays.sets {
            let figures = pool.install(|| answer(contender, set, rounds));
            contender.figures.push(figures);
            step()?;
        }
    }
    take_times(contenders, rays, rounds, pool, step)?;
    let took = progress.elapsed();
    progress.finish(&format!("measured {count} contenders with {sets} sets of rays in {took:.2?}"));
    Ok(())
}

/// Fills in the times. The contenders take turns, so that a change of the machine's speed meets
/// all of them.
fn take_times(
    contenders: &mut [Contender<'_>],
    rays: &RaySets,
    rounds: u32,
    pool: &ThreadPool,
    step: impl Fn() -> Result<(), CliError>,
) -> Result<(), CliError> {
    let mut seconds = vec![Vec::new(); contenders.len() * rays.sets.len()];
    for _ in 0..rounds {
        for (i, contender) in contenders.iter().enumerate() {
            for (j, set) in rays.sets.iter().enumerate() {
                let stride = contender.figures[j].stride;
                let took = pool.install(|| time(contender, set, stride));
                seconds[i * rays.sets.len() + j].push(took);
                step()?;
            }
        }
    }
    let figures = contenders.iter_mut().flat_map(|contender| &mut contender.figures);
    for (figures, mut seconds) in figures.zip(seconds) {
        figures.seconds = median(&mut seconds);
    }
    Ok(())
}

/// Fails if two contenders gave different answers to a ray that both were asked.
pub(super) fn check_answers(contenders: &[Contender<'_>]) -> Result<(), CliError> {
    let Some((last, others)) = contenders.split_last() else { return Ok(()) };
    for other in others {
        for (all, found) in last.figures.iter().zip(&other.figures) {
            let asked = all.answers.iter().step_by(found.stride.max(1));
            for (i, (expected, found_answer)) in asked.zip(&found.answers).enumerate() {
                if expected != found_answer {
                    return Err(CliError::Disagreement(format!(
                        "{} and {} disagree on ray {} of set {}: {found_answer:?} and {expected:?}",
                        other.name,
                        last.name,
                        i * found.stride,
                        all.set,
                    )));
                }
            }
        }
    }
    Ok(())
}

/// The middle value; of an even number the lower one of the two. Zero of none.
pub(super) fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len().saturating_sub(1) / 2).copied().unwrap_or(0.0)
}

fn answer(contender: &Contender<'_>, set: &RaySet, rounds: u32) -> Figures {
    match &contender.kind {
        Kind::Tree { scene, .. } => by_tree(scene, set),
        Kind::Naive { mesh, bounds } => by_testing_all(mesh, bounds, set, rounds),
    }
}

fn by_tree(scene: &ShapeScene, set: &RaySet) -> Figures {
    let ask = |ray| {
        let mut counters = Counters::default();
        let answer = match set.any {
            true => Answer::Any(scene.any_hit_traced(ray, &mut counters)),
            false => Answer::Closest(scene.closest_hit_traced(ray, &mut counters)),
        };
        (answer, counters)
    };
    let found: Vec<(Answer, Counters)> = set.rays.par_iter().map(ask).collect();
    let counters = found.iter().map(|(_, counters)| *counters).sum();
    let answers: Vec<Answer> = found.into_iter().map(|(answer, _)| answer).collect();
    Figures { set: set.name, rays: answers.len(), stride: 1, counters, seconds: 0.0, answers }
}

fn by_testing_all(mesh: &TriangleMesh, bounds: &Aabb<3>, set: &RaySet, rounds: u32) -> Figures {
    let stride = naive_stride(set.rays.len(), mesh.count(), rounds);
    let counted = Counted::new(mesh);
    let naive = Naive::new(&counted, *bounds);
    let asked: Vec<&Ray> = set.rays.iter().step_by(stride).collect();
    let answers = asked.par_iter().map(|ray| match set.any {
        true => Answer::Any(naive.any_hit(ray)),
        false => Answer::Closest(naive.closest_hit(ray)),
    });
    let answers: Vec<Answer> = answers.collect();
    let counters = Counters { primitives: counted.tests(), ..Counters::default() };
    Figures { set: set.name, rays: answers.len(), stride, counters, seconds: 0.0, answers }
}

/// Every so manieth ray is asked, the first always. All rounds together cost no more than
/// [`NAIVE_TESTS`] and those of one ray, which alone are more if there are many triangles.
fn naive_stride(rays: usize, triangles: usize, rounds: u32) -> usize {
    let rounds = (rounds as usize).saturating_add(1);
    let tests = rays.saturating_mul(triangles).saturating_mul(rounds);
    tests.div_ceil(NAIVE_TESTS).max(1)
}

/// How long the set takes, in seconds.
fn time(contender: &Contender<'_>, set: &RaySet, stride: usize) -> f64 {
    let asked: Vec<Ray> = set.rays.iter().step_by(stride.max(1)).copied().collect();
    match &contender.kind {
        Kind::Tree { scene, .. } if set.any => each(&asked, |ray| scene.any_hit(ray)),
        Kind::Tree { scene, .. } => each(&asked, |ray| scene.closest_hit(ray)),
        Kind::Naive { mesh, bounds } => {
            let naive = Naive::new(*mesh, *bounds);
            match set.any {
                true => each(&asked, |ray| naive.any_hit(ray)),
                false => each(&asked, |ray| naive.closest_hit(ray)),
            }
        }
    }
}

fn each<A>(rays: &[Ray], ask: impl Fn(&Ray) -> A + Sync) -> f64 {
    let start = Instant::now();
    if rayon::current_num_threads() == 1 {
        for ray in rays {
            black_box(ask(ray));
        }
    } else {
        rays.par_iter().with_min_len(256).for_each(|ray| {
            black_box(ask(ray));
        });
    }
    start.elapsed().as_secs_f64()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_are_values_that_were_measured() {
        assert_eq!(median(&mut [3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&mut [4.0, 1.0, 3.0, 2.0]), 2.0);
        assert_eq!(median(&mut []), 0.0);
    }

    #[test]
    fn many_rays_and_rounds_do_not_wrap() {
        assert_eq!(naive_stride(10, 10, 5), 1);
        assert_eq!(naive_stride(1_000_000, 6, 9), 1);
        assert_eq!(naive_stride(1_000_000, 600, 9), 100);
        assert_eq!(naive_stride(usize::MAX, 2, u32::MAX), usize::MAX.div_ceil(NAIVE_TESTS));
    }

    #[test]
    fn the_naive_answer_costs_at_most_one_ray_more_than_it_may() {
        let (rays, rounds) = (20_034, 5);
        for triangles in [1, 8, 1000, 402_700, 70_000_000] {
            let asked = (0..rays).step_by(naive_stride(rays, triangles, rounds)).count();
            let one_ray = triangles * (rounds as usize + 1);
            assert!(asked >= 1 && asked * one_ray <= NAIVE_TESTS + one_ray, "{asked}");
        }
    }

    fn contender(name: &'static str, stride: usize, answers: Vec<Answer>) -> Contender<'static> {
        let kind = Kind::Naive { mesh: Box::leak(Box::default()), bounds: Aabb::EMPTY };
        let rays = answers.len();
        let figures = Figures { set: "primary", rays, stride, answers, ..Figures::default() };
        Contender { name, kind, figures: vec![figures] }
    }

    #[test]
    fn a_different_answer_is_an_error_that_names_the_ray() {
        let all = [true, false, true, true, false].map(Answer::Any).to_vec();
        let some = vec![all[0], all[2], all[4]];
        let same = [contender("naive", 2, some), contender("sah", 1, all.clone())];
        assert!(check_answers(&same).is_ok());
        let wrong = [true, true, true].map(Answer::Any).to_vec();
        let different = [contender("naive", 2, wrong), contender("sah", 1, all)];
        let error = check_answers(&different).unwrap_err().to_string();
        assert!(error.contains("naive and sah disagree on ray 4 of set primary"), "{error}");
    }
}
