//! All targets in turn, with trees by all settings, until there were rays enough.

use super::aim::Gunner;
use super::case::{Case, Tamper, shoot};
use super::verdict::Judge;
use super::volley::SIZE;
use super::{AnyTarget, Attacked, FEW, Tally, Target, settings, targets, trees};
use crate::flat::Flat;
use kdray::Scene;
use rayon::prelude::*;
use std::ops::Range;
use std::time::{Duration, Instant};

/// In the first round each target has as many volleys as its weight, in each later one twice as many as before, up to
/// so many times as many: so all targets have their turn early, and large trees are not built often.
const LONGEST: u64 = 32;

/// A ray that touches more triangles is so slow that its target has no more volleys than in the first round.
const DEEP: u64 = 1000;

/// In how many parts, each with a tree by another setting, a small target has its volleys of a round.
const PARTS: u64 = 4;

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
    pub case: Option<SmallCase>,
    /// What was wrong of it.
    pub example: Option<String>,
    /// How many volleys there were, and how many trees for them.
    pub(super) volleys: u64,
    pub(super) parts: u64,
}

/// A case that was made as small as possible.
#[derive(Clone, Debug)]
pub struct SmallCase {
    /// How many rays it has.
    pub rays: usize,
    /// How many triangles.
    pub triangles: usize,
    /// The case as a file for `tests/repro`.
    pub text: String,
}

/// The attack on some targets.
pub struct Campaign<'a> {
    /// What is shot at.
    pub targets: Vec<AnyTarget>,
    /// What all chance depends on.
    pub seed: u64,
    /// Whether nothing else is asked about, and trees are not compared.
    pub rays_only: bool,
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
    /// Shoots in rounds: in each every target has volleys by its weight, until there were rays enough.
    pub fn run(&self) -> Vec<Outcome> {
        let mut outcomes: Vec<Outcome> = self.targets.iter().map(Outcome::of).collect();
        let weights: Vec<u64> = outcomes.iter().map(Outcome::weight).collect();
        let rays_of_one = weights.iter().sum::<u64>() * SIZE as u64;
        let (mut rays, mut times) = (0, 1);
        while rays < self.limits.rays && rays_of_one > 0 {
            let left = (self.limits.rays - rays).div_ceil(rays_of_one);
            for ((target, outcome), weight) in self.targets.iter().zip(&mut outcomes).zip(&weights)
            {
                if self.is_over() {
                    return outcomes;
                }
                (self.progress)(rays, target.name());
                let before = outcome.tally.rays;
                // Lists of so many hits take their time.
                let most = if outcome.tally.deepest > DEEP { 1 } else { times };
                let volleys = weight * left.min(most);
                match target {
                    AnyTarget::Single(target) => self.attack(target, outcome, volleys),
                    AnyTarget::Double(target) => self.attack(target, outcome, volleys),
                }
                rays += outcome.tally.rays - before;
            }
            times = LONGEST.min(2 * times);
        }
        (self.progress)(rays, "done");
        outcomes
    }

    fn is_over(&self) -> bool {
        (self.is_stopped)() || self.limits.until.is_some_and(|end| Instant::now() >= end)
    }

    /// A target's share of a round.
    fn attack<T: Attacked>(&self, target: &Target<T>, outcome: &mut Outcome, volleys: u64) {
        let flat = Flat::new(&target.mesh);
        let gunner = Gunner::new(target, &flat, self.seed);
        let parts = if outcome.is_small() { PARTS.min(volleys) } else { 1 };
        for part in 0..parts {
            let count = volleys / parts + u64::from(part < volleys % parts);
            let numbers = outcome.volleys..outcome.volleys + count;
            self.attack_part(target, &flat, &gunner, outcome, numbers);
            outcome.volleys += count;
            outcome.parts += 1;
        }
    }

    /// The volleys of some numbers at one tree.
    fn attack_part<T: Attacked>(
        &self,
        target: &Target<T>,
        flat: &Flat<T>,
        gunner: &Gunner<'_, T>,
        outcome: &mut Outcome,
        numbers: Range<u64>,
    ) {
        let place = outcome.parts + target.first / targets::VOLLEYS;
        let names = settings::names(outcome.triangles);
        let name = names[place as usize % names.len()];
        let options = settings::named(name);
        let scene = match Scene::build(target.mesh.clone(), &options) {
            Ok(scene) => scene,
            Err(error) => return outcome.refused(&format!("{name}: {error}")),
        };
        let judge = Judge::of(target, flat);
        let shot = |number: u64| {
            if self.is_over() {
                return (number, Tally::default());
            }
            let volley = gunner.volley(number, &scene);
            (number, shoot(&scene, judge, &volley, self.tamper))
        };
        let tallies: Vec<(u64, Tally)> = numbers.clone().into_par_iter().map(shot).collect();
        for (number, tally) in tallies {
            if tally.errors() > 0 && outcome.case.is_none() {
                let volley = gunner.volley(number, &scene);
                outcome.example.clone_from(&tally.example);
                let soup =
                    (0..outcome.triangles as u32).map(|id| target.mesh.corners(id)).collect();
                let case = Case { soup, settings: name.to_owned(), volley };
                outcome.case = Some(SmallCase::of(case.smallest(self.tamper, self.shrink)));
            }
            outcome.tally = std::mem::take(&mut outcome.tally).and(tally);
        }
        if self.rays_only {
            return;
        }
        let visit = Visit { target, flat, scene: &scene, gunner, numbers, seed: self.seed };
        let others = visit.other_queries();
        if others.errors() > 0 && outcome.example.is_none() {
            outcome.example.clone_from(&others.example);
        }
        outcome.tally = std::mem::take(&mut outcome.tally).and(others);
        if outcome.parts < trees::settings_tried(outcome.triangles) {
            let rays = gunner.volley(0, &scene).rays;
            let (differ, all) = trees::differing(&target.mesh, &options, &rays);
            outcome.trees = (outcome.trees.0 + differ, outcome.trees.1 + all);
        }
    }
}

/// A target with one of its trees.
pub struct Visit<'a, T: 'static> {
    /// The target.
    pub target: &'a Target<T>,
    /// Its triangles.
    pub flat: &'a Flat<T>,
    /// With a tree.
    pub scene: &'a Scene<T>,
    /// Who aims at it.
    pub gunner: &'a Gunner<'a, T>,
    /// The volleys that were shot.
    pub numbers: Range<u64>,
    /// What all chance depends on.
    pub seed: u64,
}

impl SmallCase {
    fn of<T: Attacked>(case: Case<T>) -> Self {
        Self { rays: case.volley.rays.len(), triangles: case.soup.len(), text: case.to_string() }
    }
}

impl Outcome {
    fn of(target: &AnyTarget) -> Self {
        Self {
            name: target.name().to_owned(),
            triangles: target.triangles(),
            is_closed: target.is_closed(),
            ..Self::default()
        }
    }

    fn is_small(&self) -> bool {
        self.triangles <= FEW
    }

    /// How many times as many volleys it has as a large target.
    fn weight(&self) -> u64 {
        match self.triangles {
            _ if self.is_small() => targets::VOLLEYS,
            ..=50_000 => 2,
            _ => 1,
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
