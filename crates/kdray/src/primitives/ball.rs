//! Circles and spheres.

use super::{Hit, HitRule, Intersect, Primitives, Side};
use crate::geometry::{Aabb, Chord, Ray, chord};
use thiserror::Error;

/// Circles (K = 2) or spheres (K = 3): the set of points at a distance from a centre. A ray that
/// passes through one meets it twice; one that is tangent misses it.
///
/// Hits are computed in f64, not decided exactly as those of triangles are. They lie within a
/// ball's bounds for rays from up to 2^20 times the largest coordinate away; from farther, whether
/// a ray is told to graze a ball or to pass it by may depend on the tree.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Balls<const K: usize> {
    balls: Vec<([f32; K], f32)>,
}

/// Why a list of balls cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "ball {0} has a centre or radius that is not finite, or a negative radius; mend or drop it"
)]
pub struct BallError(pub usize);

impl<const K: usize> Balls<K> {
    /// Balls of the given centres and radii.
    ///
    /// # Errors
    /// The first ball whose centre or radius is not finite, or whose radius is negative.
    pub fn new(balls: Vec<([f32; K], f32)>) -> Result<Self, BallError> {
        let bad = |(center, radius): &([f32; K], f32)| {
            *radius < 0.0 || !radius.is_finite() || !center.iter().all(|x| x.is_finite())
        };
        match balls.iter().position(bad) {
            Some(index) => Err(BallError(index)),
            None => Ok(Self { balls }),
        }
    }

    /// The centre and the radius of each ball.
    pub fn centers_and_radii(&self) -> &[([f32; K], f32)] {
        &self.balls
    }
}

impl<const K: usize> Primitives<K> for Balls<K> {
    fn count(&self) -> usize {
        self.balls.len()
    }

    fn bounds(&self, id: u32) -> Aabb<K> {
        let (center, radius) = self.balls[id as usize];
        // What rounding may move a hit by, see the type's documentation.
        let reach = center.iter().fold(radius, |reach, c| reach.max(c.abs()));
        let radius = radius + reach * (1.0 / (1 << 20) as f32);
        Aabb {
            min: center.map(|c| (c - radius).next_down()),
            max: center.map(|c| (c + radius).next_up()),
        }
    }
}

impl<const K: usize> Intersect<K> for Balls<K> {
    fn intersect(&self, id: u32, ray: &Ray<K>, _rule: HitRule, report: &mut impl FnMut(Hit)) {
        let (center, radius) = self.balls[id as usize];
        let chord = chord(ray, &center.map(f64::from), f64::from(radius));
        let Some(Chord { t: [enter, leave], is_tangent: false }) = chord else { return };
        for (t, side) in [(enter, Side::Front), (leave, Side::Back)] {
            if t.is_finite() && ray.interval.contains(t) {
                report(Hit { t, primitive_id: id, u: 0.0, v: 0.0, side });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_through_the_middle_meets_both_sides() {
        let balls = Balls::new(vec![([0.0, 0.0, 5.0], 2.0)]).unwrap();
        let ray = Ray::new([0.0; 3], [0.0, 0.0, 2.0]);
        let mut hits = Vec::new();
        balls.intersect(0, &ray, HitRule::Crossing, &mut |hit| hits.push((hit.t, hit.side)));
        assert_eq!(hits, [(1.5, Side::Front), (3.5, Side::Back)]);
    }

    #[test]
    fn a_ball_far_away_is_met_twice_though_both_t_round_to_one() {
        for (center, radius, origin) in [([0.0, 0.0], 1.0, -1e17), ([1.0, 1.0], 5e-13, -1e4)] {
            let balls = Balls::new(vec![(center, radius)]).unwrap();
            let ray = Ray::new([origin, f64::from(center[1])], [1.0, 0.0]);
            let mut sides = Vec::new();
            balls.intersect(0, &ray, HitRule::Crossing, &mut |hit| sides.push(hit.side));
            assert_eq!(sides, [Side::Front, Side::Back], "from {origin}");
        }
    }

    #[test]
    fn bad_balls_are_named() {
        assert_eq!(Balls::new(vec![([0.0], 1.0), ([0.0], -1.0)]), Err(BallError(1)));
        assert_eq!(Balls::new(vec![([f32::NAN, 0.0], 1.0)]), Err(BallError(0)));
    }
}
