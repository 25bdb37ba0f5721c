//! All targets in turn, with trees by all settings, until there were rays enough.

use super::aim::{Gunner, KINDS};
use super::case::{Case, Tamper, shoot};
use super::verdict::Judge;
use super::volley::SIZE;
use super::{Tally, Target, settings, trees};
use crate::flat::Flat;
use kdray::Scene;
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// When to end.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// After so many rays, or somewhat more: every target has its share in every round.
    pub rays: u64,
    /// At this time, if it comes earlier.
    pub until: Option<Instant>,
}

/// What came of a target.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// Its name.
    pub name: String,
    /// How many triangles it has.
    pub triangles: usize,
    /// Whether it is closed.
    pub is_closed: bool,
    /// What was wrong, in all rounds.
    pub tally: Tally,
    /// Builds and traces that were not the same as others, and how many there were.
    pub trees: (u64, u64),
    /// The first case that failed, made small.
    pub case: Option<Case>,
    /// What was wrong of it.
    pub example: Option<String>,
}

/// The attack on some targets.
pub struct Campaign<'a> {
    /// What is shot at.
    pub targets: Vec<Target>,
    /// What all chance depends on.
    pub seed: u64,
    /// When to end.
    pub limits: Limits,
    /// Whether someone wants it to end.
    pub is_stopped: &'a (dyn Fn() -> bool + Sync),
    /// Told how many rays there were, after each target.
    pub progress: &'a (dyn Fn(u64, &str) + Sync),
    /// How long a failing case is made smaller.
    pub shrink: Duration,
    /// Spoils answers, to test whether that is found.
    pub tamper: Option<Tamper<'a>>,
}

impl Campaign<'_> {
    /// Shoots in rounds: each round takes another setting of the tree, and a part of the rays for each
    /// target.
    pub fn run(&self) -> Vec<Outcome> {
        let mut outcomes: Vec<Outcome> = self.targets.iter().map(Outcome::of).collect();
        let (rounds, volleys) = self.rounds_and_volleys();
        let mut rays = 0;
        for round in 0..rounds {
            for (target, outcome) in self.targets.iter().zip(&mut outcomes) {
                if self.is_over() {
                    return outcomes;
                }
                (self.progress)(rays, &target.name);
                let before = outcome.tally.rays;
                self.attack(target, outcome, round, volleys);
                rays += outcome.tally.rays - before;
            }
        }
        (self.progress)(rays, "done");
        outcomes
    }

    /// How many rounds there are, and how many volleys at each target in each.
    fn rounds_and_volleys(&self) -> (u64, u64) {
        let volleys = self.limits.rays.div_ceil(self.targets.len().max(1) as u64 * SIZE as u64);
        // Few volleys in each round: when time ends, all targets had their turn.
        let rounds = volleys.div_ceil(4 * KINDS).max(volleys.min(settings::NAMES.len() as u64));
        (rounds, volleys.div_ceil(rounds.max(1)))
    }

    fn is_over(&self) -> bool {
        (self.is_stopped)() || self.limits.until.is_some_and(|end| Instant::now() >= end)
    }

    /// One round at one target.
    fn attack(&self, target: &Target, outcome: &mut Outcome, round: u64, volleys: u64) {
        let name = settings::NAMES[round as usize % settings::NAMES.len()];
        let options = settings::named(name);
        let scene = match Scene::build(target.mesh.clone(), &options) {
            Ok(scene) => scene,
            Err(error) => return outcome.refused(&format!("{name}: {error}")),
        };
        let flat = Flat::new(&target.mesh);
        let gunner = Gunner::new(target, &flat, self.seed);
        let judge = Judge::of(target, &flat);
        let shots = (round * volleys..(round + 1) * volleys).into_par_iter();
        let shot = |number: u64| {
            if self.is_over() {
                return (number, Tally::default());
            }
            let volley = gunner.volley(number, &scene);
            (number, shoot(&scene, judge, &volley, self.tamper))
        };
        let tallies: Vec<(u64, Tally)> = shots.map(shot).collect();
        for (number, tally) in tallies {
            if tally.errors() > 0 && outcome.case.is_none() && outcome.example.is_none() {
                let ids = 0..target.mesh.triangles().len() as u32;
                let soup = ids.map(|id| target.mesh.corners(id)).collect();
                let volley = gunner.volley(number, &scene);
                let case = Case { soup, settings: name.to_owned(), volley };
                outcome.example.clone_from(&tally.example);
                outcome.case = Some(case.smallest(self.tamper, self.shrink));
            }
            outcome.tally = std::mem::take(&mut outcome.tally).and(tally);
        }
        if round < trees::settings_tried(target.mesh.triangles().len()) {
            let rays = gunner.volley(0, &scene).rays;
            let (differ, all) = trees::differing(&target.mesh, &options, &rays);
            outcome.trees = (outcome.trees.0 + differ, outcome.trees.1 + all);
        }
    }
}

impl Outcome {
    fn of(target: &Target) -> Self {
        Self {
            name: target.name.clone(),
            triangles: target.mesh.triangles().len(),
            is_closed: target.is_closed,
            ..Self::default()
        }
    }

    /// A tree that cannot be built is an error, too.
    fn refused(&mut self, why: &str) {
        self.trees.0 += 1;
        self.trees.1 += 1;
        self.example.get_or_insert_with(|| why.to_owned());
    }

    /// How much is wrong.
    pub fn errors(&self) -> u64 {
        self.tally.errors() + self.trees.0
    }
}
