//! The exact answers, and how far those of a contender are from them.
//!
//! The reference is kdray's scalar traversal, which decides every hit as if in real arithmetic on
//! the given floats. Its own test suite holds it against an oracle in rational numbers.

use crate::contender::{Answers, Found};
use crate::error::BenchError;
use crate::rays::{Question, Ray, RaySet};
use glam::Vec3;
use kdray::{BuildOptions, Hit, ShapeScene, Strategy, TriangleMesh};
use rayon::prelude::*;
use serde::Serialize;

/// Two hits are at the same place if they are no farther apart than this, by the sum of the scene's
/// diagonal and the distance of the exact hit: about two hundred roundings of an f32.
const TOLERANCE: f64 = 2e-5;

/// The exact traversal.
pub(crate) struct Reference {
    scene: ShapeScene,
}

/// What is true of the rays of a set.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Truth {
    /// The t of each closest hit; infinite if there is none.
    Closest(Vec<f64>),
    /// Whether there is any hit.
    Any(Vec<bool>),
}

/// How many answers of a set are wrong.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub(crate) struct Wrong {
    /// The ray hits, the contender says that it does not.
    pub(crate) lost: u64,
    /// The ray does not hit, the contender says that it does.
    pub(crate) phantom: u64,
    /// Both hit, at different places. Never for rays that ask for any hit.
    pub(crate) far: u64,
}

/// The ray as the library takes it, without loss.
pub(crate) fn exact_ray(ray: &Ray) -> kdray::Ray {
    kdray::Ray::from_f32(ray.origin, ray.direction).with_interval(0.0, f64::from(ray.t_max))
}

impl Reference {
    /// Builds a tree over the triangles.
    pub(crate) fn build(mesh: &TriangleMesh) -> Result<Self, BenchError> {
        Ok(Self {
            scene: ShapeScene::build(mesh.clone(), &BuildOptions::for_strategy(Strategy::Sah))?,
        })
    }

    /// The closest hits, found on all processors.
    pub(crate) fn hits(&self, rays: &[Ray]) -> Vec<Option<Hit>> {
        rays.par_iter().map(|ray| self.scene.closest_hit(&exact_ray(ray))).collect()
    }

    /// What is true of a set.
    pub(crate) fn truth(&self, set: &RaySet) -> Truth {
        let any = |ray| self.scene.any_hit(&exact_ray(ray));
        match set.kind.question() {
            Question::Any => Truth::Any(set.rays.par_iter().map(any).collect()),
            Question::Closest => {
                let t = |hit: Option<Hit>| hit.map_or(f64::INFINITY, |hit| hit.t);
                Truth::Closest(self.hits(&set.rays).into_iter().map(t).collect())
            }
        }
    }
}

impl Truth {
    /// What is true of the rays of these runs.
    pub(crate) fn sample(&self, runs: &[std::ops::Range<usize>]) -> Self {
        match self {
            Self::Closest(t) => {
                Self::Closest(runs.iter().flat_map(|run| &t[run.clone()]).copied().collect())
            }
            Self::Any(any) => {
                Self::Any(runs.iter().flat_map(|run| &any[run.clone()]).copied().collect())
            }
        }
    }

    /// Counts the wrong ones among `answers` to `rays`, in a scene of that `diagonal`.
    pub(crate) fn check(&self, answers: &Answers, rays: &[Ray], diagonal: f64) -> Wrong {
        let mut wrong = Wrong::default();
        match (self, answers) {
            (Self::Closest(truth), Answers::Closest(found)) => {
                for ((&t, found), ray) in truth.iter().zip(found).zip(rays) {
                    wrong.count_closest(t, found, ray, diagonal);
                }
            }
            (Self::Any(truth), Answers::Any(found)) => {
                for (&truth, &found) in truth.iter().zip(found) {
                    wrong.lost += u64::from(truth && !found);
                    wrong.phantom += u64::from(!truth && found);
                }
            }
            _ => wrong.lost = rays.len() as u64,
        }
        wrong
    }
}

impl Wrong {
    fn count_closest(&mut self, t: f64, found: &Found, ray: &Ray, diagonal: f64) {
        match (t.is_finite(), found.is_hit()) {
            (true, false) => self.lost += 1,
            (false, true) => self.phantom += 1,
            (false, false) => {}
            (true, true) => {
                let length = Vec3::from(ray.direction).as_dvec3().length();
                let apart = (f64::from(found.t) - t).abs() * length;
                let same = apart <= TOLERANCE * (t * length + diagonal);
                self.far += u64::from(!same);
            }
        }
    }

    /// All together.
    pub(crate) fn sum(self) -> u64 {
        self.lost + self.phantom + self.far
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RAY: Ray = Ray { origin: [0.0; 3], direction: [0.0, 0.0, 2.0], t_max: f32::INFINITY };

    #[test]
    fn wrong_answers_to_closest_are_counted_by_kind() {
        let none = f64::INFINITY;
        let truth = Truth::Closest(vec![1.0, 1.0, 1.0, none, none, 1.0]);
        let hit = |t| Found { t, id: 0 };
        let found = vec![hit(1.0), Found::MISS, hit(1.001), hit(5.0), Found::MISS, hit(1.000_001)];
        let wrong = truth.check(&Answers::Closest(found), &[RAY; 6], 1.0);
        assert_eq!(wrong, Wrong { lost: 1, phantom: 1, far: 1 });
        assert_eq!(wrong.sum(), 3);
    }

    #[test]
    fn a_hit_at_no_number_is_far() {
        let truth = Truth::Closest(vec![1.0]);
        let found = Answers::Closest(vec![Found { t: f32::NAN, id: 3 }]);
        assert_eq!(truth.check(&found, &[RAY], 1.0), Wrong { far: 1, ..Wrong::default() });
    }

    #[test]
    fn wrong_answers_to_any_are_counted_by_kind() {
        let truth = Truth::Any(vec![true, true, false, false, false]);
        let found = Answers::Any(vec![true, false, true, true, false]);
        let wrong = truth.check(&found, &[RAY; 5], 1.0);
        assert_eq!(wrong, Wrong { lost: 1, phantom: 2, far: 0 });
    }

    #[test]
    fn samples_of_the_truth_follow_the_runs() {
        let truth = Truth::Any(vec![true, false, true, false, true]);
        assert_eq!(truth.sample(&[1..2, 3..5]), Truth::Any(vec![false, false, true]));
    }
}
