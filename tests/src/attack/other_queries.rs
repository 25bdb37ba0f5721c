//! What is asked besides rays: points, tree files and copies.

use super::campaign::Visit;
use super::placed::Copies;
use super::{Attacked, FEW, Tally, points, saved, volley};
use crate::rays::random;

/// How many rays there are to a point in the first volleys at a target, and to one in the others.
const RAYS_PER_POINT: [u64; 2] = [8, 64];

/// How many volleys there are to one at copies.
const VOLLEYS_PER_COPIED: [u64; 2] = [8, 32];

/// How many volleys are the first.
const FIRST: u64 = 128;

/// How many rays at most are put to a tree file.
const RAYS_AT_FILES: usize = 16;

impl<T: Attacked> Visit<'_, T> {
    /// All that is asked besides rays at one tree.
    pub(super) fn other_queries(&self) -> Tally {
        let Self { target, flat, scene, gunner, numbers, seed } = self;
        let mut random = random(seed.wrapping_add(numbers.start).wrapping_mul(0x9e37_79b9));
        let volleys = numbers.end - numbers.start;
        let stage = usize::from(numbers.start >= FIRST);
        let count = volleys * volley::SIZE as u64 / RAYS_PER_POINT[stage];
        let points = points::attack(scene, target, flat, count, &mut random);
        let volley = gunner.volley(numbers.start, scene);
        let few: Vec<usize> = (0..volley.rays.len().min(RAYS_AT_FILES)).collect();
        let volley = volley.only(&few);
        let is_small = target.mesh.triangles().len() <= FEW;
        let saved = saved::attack(scene, flat, &volley);
        let damaged = match is_small {
            true => saved::damage(scene, &volley, volleys, &mut random),
            false => Tally::default(),
        };
        let every = |number: u64| number.div_ceil(VOLLEYS_PER_COPIED[stage]);
        let shots = every(numbers.end) - every(numbers.start);
        let copied = match Copies::new(scene, flat, &mut random) {
            Ok(Some(copies)) => copies.attack(shots, &mut random),
            Ok(None) => Tally::default(),
            Err(error) => Tally::refused(&error),
        };
        [saved, damaged, copied].into_iter().fold(points, Tally::and)
    }
}
