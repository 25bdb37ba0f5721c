//! Circles and spheres.

use super::{Hit, HitRule, Intersect, Primitives, Side};
use crate::geometry::{Aabb, Ray};
use thiserror::Error;

/// Circles (K = 2) or spheres (K = 3): the set of points at a distance from a centre. A ray that
/// passes through one meets it twice; one that is tangent misses it.
///
/// Hits are computed in f64, not decided exactly as those of triangles are.
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
}

impl<const K: usize> Primitives<K> for Balls<K> {
    fn count(&self) -> usize {
        self.balls.len()
    }

    fn bounds(&self, id: u32) -> Aabb<K> {
        let (center, radius) = self.balls[id as usize];
        // Rounding outward by a step also covers what the rounding of a hit's t moves it by.
        Aabb {
            min: center.map(|c| (c - radius).next_down()),
            max: center.map(|c| (c + radius).next_up()),
        }
    }
}

impl<const K: usize> Intersect<K> for Balls<K> {
    fn intersect(&self, id: u32, ray: &Ray<K>, _rule: HitRule, report: &mut impl FnMut(Hit)) {
        let (center, radius) = self.balls[id as usize];
        let dot = |a: &[f64; K], b: &[f64; K]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        let from_center: [f64; K] = std::array::from_fn(|k| ray.origin[k] - f64::from(center[k]));
        let length_squared = dot(&ray.direction, &ray.direction);
        let t_nearest = -dot(&from_center, &ray.direction) / length_squared;
        let nearest: [f64; K] =
            std::array::from_fn(|k| from_center[k] + t_nearest * ray.direction[k]);
        let radius = f64::from(radius);
        let half_squared = (radius * radius - dot(&nearest, &nearest)) / length_squared;
        if half_squared <= 0.0 || half_squared.is_nan() {
            return;
        }
        let half = half_squared.sqrt();
        for (t, side) in [(t_nearest - half, Side::Front), (t_nearest + half, Side::Back)] {
            if ray.interval.contains(t) {
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
    fn bad_balls_are_named() {
        assert_eq!(Balls::new(vec![([0.0], 1.0), ([0.0], -1.0)]), Err(BallError(1)));
        assert_eq!(Balls::new(vec![([f32::NAN, 0.0], 1.0)]), Err(BallError(0)));
    }
}
