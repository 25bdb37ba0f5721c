//! What is asked besides rays: points, tree files and copies.

use super::answers::{Said, in_watched_packets};
use super::campaign::Visit;
use super::placed::Copies;
use super::verdict::Judge;
use super::{Tally, points, saved};
use crate::rays::random;
use kdray::{Precision, Ray, Scene};

/// How many rays there are to a point in the first volleys at a target, and to one in the others: points take
/// several times as long.
const RAYS_PER_POINT: [u64; 2] = [32, 256];

/// How many volleys there are to one at copies.
const VOLLEYS_PER_COPIED: [u64; 2] = [8, 32];

/// How many volleys are the first.
const FIRST: u64 = 128;

/// Larger trees are not saved for every setting, and not damaged.
const FEW: usize = 2000;

/// A precision whose meshes are attacked.
pub trait Attacked: Precision {
    /// All that is asked besides rays at one tree.
    fn other_queries(visit: &Visit<'_, Self>) -> Tally;

    /// The bytes of the scene's tree file, if there is one.
    fn saved(scene: &Scene<Self>) -> Option<Vec<u8>>;

    /// What the packets that can be watched say, if there are any.
    fn in_watched_packets(scene: &Scene<Self>, rays: &[Ray], add: &mut dyn FnMut(&str, Said));
}

impl Attacked for f32 {
    fn other_queries(visit: &Visit<'_, Self>) -> Tally {
        let Visit { target, flat, scene, gunner, numbers, seed } = visit;
        let mut random = random(seed.wrapping_add(numbers.start).wrapping_mul(0x9e37_79b9));
        let volleys = numbers.end - numbers.start;
        let stage = usize::from(numbers.start >= FIRST);
        let count = volleys * super::volley::SIZE as u64 / RAYS_PER_POINT[stage];
        let points = points::attack(scene, target, flat, count, &mut random);
        let volley = gunner.volley(numbers.start, scene);
        let is_small = target.mesh.triangles().len() <= FEW;
        let saved = saved::attack(scene, &Judge::of(target, flat), &volley);
        let damaged = match is_small {
            true => saved::damage(scene, &volley, volleys, &mut random),
            false => Tally::default(),
        };
        let copies = Copies::new(scene, flat, &mut random);
        let every = |number: u64| number.div_ceil(VOLLEYS_PER_COPIED[stage]);
        let shots = every(numbers.end) - every(numbers.start);
        let copied = copies.map(|copies| copies.attack(shots, &mut random)).unwrap_or_default();
        [saved, damaged, copied].into_iter().fold(points, Tally::and)
    }

    fn saved(scene: &Scene) -> Option<Vec<u8>> {
        Some(saved::saved(scene))
    }

    fn in_watched_packets(scene: &Scene, rays: &[Ray], add: &mut dyn FnMut(&str, Said)) {
        in_watched_packets(scene, rays, add);
    }
}

impl Attacked for f64 {
    fn other_queries(_: &Visit<'_, Self>) -> Tally {
        Tally::default()
    }

    fn saved(_: &Scene<f64>) -> Option<Vec<u8>> {
        None
    }

    fn in_watched_packets(_: &Scene<f64>, _: &[Ray], _: &mut dyn FnMut(&str, Said)) {}
}
