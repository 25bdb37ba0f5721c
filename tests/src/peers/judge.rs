//! What is wrong of a peer's answers. The judge knows the truth from closed meshes and rational arithmetic,
//! and kdray is judged like everyone else.
//!
//! Whether a ray that only grazes a surface hits it depends on what a hit is. So a ray counts as lost only
//! if it crosses the surface in whichever of four ways it is moved by an infinitesimal, and a hit as phantom
//! only if the ray does not even touch the surface. The number of hits must be even from outside and odd
//! from inside, which holds for every way to count each crossing once.

use super::cases::{Aim, Case, Shot};
use super::files::Answers;
use crate::attack::Truth;
use crate::flat::Flat;
use kdray::{Interval, Ray, TriangleMesh};
use rayon::prelude::*;

/// The t of peers is an f32 and may be off by this part.
const T_ERROR: f64 = 1e-3;

/// What is true of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known {
    aim: Aim,
    /// Whether it crosses the surface, in whichever of four ways it is moved.
    crosses: bool,
    /// Whether it touches the surface at all.
    touches: bool,
    /// The t of the farthest of its first crossings, in whichever way it is moved; infinite if it may cross nothing.
    first: f64,
    /// Whether it begins in the inside.
    from_inside: bool,
}

/// How many answers are wrong.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wrong {
    /// How many rays there were.
    pub rays: u64,
    /// Closest and any hits of rays that cross the surface, and are said to hit nothing.
    pub lost: u64,
    /// Closest hits that lie behind the surface, if there are any t.
    pub passed: Option<u64>,
    /// The same of rays that do not touch the surface, and are said to hit it.
    pub phantom: u64,
    /// Lists of hits whose number has the wrong parity, if there are lists.
    pub miscounted: Option<u64>,
    /// Lists in which a hit stands before a nearer one, if there are lists.
    pub disordered: Option<u64>,
}

/// The truth about all rays of a case.
pub fn truths(case: &Case) -> Vec<Known> {
    let mirrors = [[1.0; 3], [-1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, -1.0]];
    let flats = mirrors.map(|mirror| Flat::new(&mirrored(&case.target.mesh, mirror)));
    let known = |shot: &Shot| {
        let crosses = |turn: usize| {
            let ray = mirrored_ray(&shot.ray, mirrors[turn]);
            let truth = Truth::of(&flats[turn], &ray);
            // At t = 0 there is none: rays begin off the surface.
            let ahead = truth.crossed.iter().map(|hit| hit.t).filter(|&t| t > 0.0);
            (ahead.fold(f64::INFINITY, f64::min), truth)
        };
        let (first, truth) = crosses(0);
        let is_touch = |t: f64| Interval::FORWARD.contains(t);
        // Moved rays differ from each other only where the line meets an edge.
        let turns = if truth.is_close { 1..4 } else { 0..0 };
        let first = turns.map(|turn| crosses(turn).0).fold(first, f64::max);
        Known {
            aim: shot.aim,
            crosses: first.is_finite(),
            touches: truth.touched.iter().any(|hit| is_touch(hit.t)),
            first,
            from_inside: shot.from_inside,
        }
    };
    case.shots.par_iter().map(known).collect()
}

/// The mesh in mirrors perpendicular to the axes of −1: the oracle, which moves all rays alike, moves them
/// otherwise there.
fn mirrored(mesh: &TriangleMesh, mirror: [f64; 3]) -> TriangleMesh {
    let point = |p: &[f32; 3]| std::array::from_fn(|k| p[k] * mirror[k] as f32);
    let vertices = mesh.vertices().iter().map(point).collect();
    TriangleMesh::new(vertices, mesh.triangles().to_vec()).expect("mirrors keep numbers finite")
}

fn mirrored_ray(ray: &Ray, mirror: [f64; 3]) -> Ray {
    let [origin, direction] =
        [ray.origin, ray.direction].map(|v| std::array::from_fn(|k| v[k] * mirror[k]));
    Ray { origin, direction, ..*ray }
}

/// What is wrong of the answers to rays of that aim; of all for none.
pub fn judge(truths: &[Known], answers: &Answers, aim: Option<Aim>) -> Wrong {
    let lists = answers.all.as_ref();
    let zero = || lists.map(|_| 0);
    let passed = answers.say_where().then_some(0);
    let mut wrong = Wrong { passed, miscounted: zero(), disordered: zero(), ..Wrong::default() };
    for (index, known) in truths.iter().enumerate() {
        if aim.is_some_and(|aim| aim != known.aim) {
            continue;
        }
        wrong.rays += 1;
        let t = answers.closest.as_ref().map(|t| t[index]);
        let closest = t.map(f32::is_finite);
        let is_passed = t.is_some_and(|t| {
            t.is_finite() && known.crosses && f64::from(t) > known.first * (1.0 + T_ERROR)
        });
        wrong.passed = wrong.passed.map(|n| n + u64::from(is_passed));
        let any = answers.any.as_ref().map(|any| any[index] != 0);
        for is_hit in [closest, any].into_iter().flatten() {
            wrong.lost += u64::from(known.crosses && !is_hit);
            wrong.phantom += u64::from(!known.touches && is_hit);
        }
        if let Some(list) = lists.map(|lists| lists.of(index)) {
            let is_odd = list.len() % 2 == 1;
            wrong.miscounted = wrong.miscounted.map(|n| n + u64::from(is_odd != known.from_inside));
            wrong.disordered = wrong.disordered.map(|n| n + u64::from(!list.is_sorted()));
        }
    }
    wrong
}

impl Wrong {
    /// Both together.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        let sum = |a: Option<u64>, b: Option<u64>| Some(a? + b?);
        Self {
            rays: self.rays + other.rays,
            lost: self.lost + other.lost,
            passed: sum(self.passed, other.passed),
            phantom: self.phantom + other.phantom,
            miscounted: sum(self.miscounted, other.miscounted),
            disordered: sum(self.disordered, other.disordered),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::files::{About, Lists};
    use super::*;

    fn known(crosses: bool, touches: bool, from_inside: bool) -> Known {
        let first = if crosses { 1.0 } else { f64::INFINITY };
        Known { aim: Aim::Vertex, crosses, touches, first, from_inside }
    }

    #[test]
    fn a_ray_that_grazes_may_hit_or_not() {
        let truths =
            [known(true, true, false), known(false, true, false), known(false, false, false)];
        let said = |hit: [f32; 3], lists: [u64; 4], t: Vec<f32>| Answers {
            about: About::default(),
            closest: Some(hit.to_vec()),
            any: None,
            all: Some(Lists { splits: lists.to_vec(), t }),
        };
        let (none, hit) = (f32::INFINITY, 1.0);
        let right = said([hit, none, none], [0, 2, 4, 4], vec![1.0, 2.0, 3.0, 3.0]);
        let (miscounted, disordered) = (Some(0), Some(0));
        let passed = Some(0);
        let expected = Wrong { rays: 3, passed, miscounted, disordered, ..Wrong::default() };
        assert_eq!(judge(&truths, &right, None), expected);
        let wrong = said([none, hit, hit], [0, 1, 3, 3], vec![1.0, 3.0, 2.0]);
        let found = judge(&truths, &wrong, Some(Aim::Vertex));
        assert_eq!((found.lost, found.phantom, found.passed), (1, 1, Some(0)));
        assert_eq!((found.miscounted, found.disordered), (Some(1), Some(1)));
        assert_eq!(judge(&truths, &wrong, Some(Aim::Anything)).rays, 0);
        // The first of two surfaces is passed by.
        let through = said([2.0, hit, none], [0, 2, 4, 4], vec![1.0, 2.0, 3.0, 3.0]);
        assert_eq!(judge(&truths, &through, None), Wrong { passed: Some(1), ..expected });
        // Who says only whether there is a hit writes zero for each.
        let without_t = said([0.0, none, none], [0, 2, 4, 4], vec![1.0, 2.0, 3.0, 3.0]);
        assert_eq!(judge(&truths, &without_t, None), Wrong { passed: None, ..expected });
    }

    #[test]
    fn from_inside_all_rays_cross_and_along_a_rim_none_does_for_sure() {
        let case = super::super::cases::all(200, 1).remove(0);
        let truths = truths(&case);
        assert!(truths.iter().all(|known| !known.from_inside || known.crosses));
        assert!(truths.iter().all(|known| !known.crosses || known.touches));
        let counts = |it: fn(&Known) -> bool| truths.iter().filter(|known| it(known)).count();
        assert!(counts(|it| it.touches && !it.crosses) > 10 && counts(|it| it.from_inside) > 10);
    }
}
