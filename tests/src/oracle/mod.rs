//! The right answer, in rational arithmetic.
//!
//! Nothing here calls `kdray::exact` or uses its formulas. The line of the ray is put into the
//! plane of the triangle (the line of the segment), and the barycentric weights of the point where
//! they meet are solved for; a closed primitive is hit where none of them is negative. For
//! [`HitRule::Crossing`] the same is done with an origin that is a polynomial in an infinitesimal ε.

mod compare;
mod integers;
mod point;
mod segment;
mod solid_angle;
mod triangle;

pub use compare::{agrees_on_all, agrees_on_closest};
pub use point::{
    exact_distance_squared, exactly_contains, is_between, is_distance, is_exactly_visible,
};
pub use segment::exact_segment_hit;
pub use solid_angle::exact_half_angle;
pub use triangle::exact_triangle_hit;

use integers::{Vector, integers, ratio, sign};
use kdray::primitives::HitRule;
use kdray::{Ray, Side};
use num_bigint::{BigInt, Sign};
use num_rational::BigRational;
use num_traits::ToPrimitive;

/// A hit on the whole line of a ray, its interval not yet looked at.
#[derive(Clone, Debug)]
pub struct ExactHit {
    /// Which primitive is hit.
    pub primitive_id: u32,
    /// The ray's parameter.
    pub t: BigRational,
    /// The weight of the second vertex.
    pub u: f64,
    /// The weight of the third vertex; zero on a segment.
    pub v: f64,
    /// The side the ray came from.
    pub side: Side,
    /// Whether it counts for [`HitRule::Crossing`] too.
    pub crosses: bool,
}

impl ExactHit {
    fn counts_for(&self, rule: HitRule) -> bool {
        rule == HitRule::Touching || self.crosses
    }
}

/// What decides whether a line meets a primitive: numbers that are linear in the line's origin.
struct Terms<const N: usize> {
    /// Zero for a direction parallel to the primitive; negative for one from its front.
    along_normal: BigInt,
    /// The barycentric weights of the meeting point times `along_normal` and a positive number.
    weights: [BigInt; N],
}

/// Whether the line touches, and if so its terms, and whether the moved line hits as well.
///
/// The moved ray has the origin o + (ε, ε², ε³), in 2-D without the last. Since weights are linear in the
/// origin, what they gain by a step along an axis, as `gains` says, is the coefficient of that power of ε. They
/// matter only where a weight is zero: moved, no line hits what it does not touch.
fn decide<const K: usize, const N: usize>(
    plain: Terms<N>,
    gains: impl Fn(&Vector<K>) -> [BigInt; N],
) -> Option<(Terms<N>, bool)> {
    let side = sign(&plain.along_normal);
    let is_zero = |weight: &BigInt| sign(weight) == Sign::NoSign;
    let touches = plain.weights.iter().all(|weight| is_zero(weight) || sign(weight) == side);
    if side == Sign::NoSign || !touches {
        return None;
    }
    let zeros: Vec<usize> = (0..N).filter(|&i| is_zero(&plain.weights[i])).collect();
    let axes = if zeros.is_empty() { 0..0 } else { 0..K };
    let moves: Vec<[BigInt; N]> = axes.map(|axis| gains(&Vector::step(axis))).collect();
    let crosses = zeros.into_iter().all(|i| {
        let first = moves.iter().find(|gained| !is_zero(&gained[i]));
        first.is_some_and(|gained| sign(&gained[i]) == side)
    });
    Some((plain, crosses))
}

/// The side that a line with these terms comes from.
fn side_of<const N: usize>(terms: &Terms<N>) -> Side {
    if sign(&terms.along_normal) == Sign::Minus { Side::Front } else { Side::Back }
}

/// The share of the weight `i`.
fn share<const N: usize>(terms: &Terms<N>, i: usize) -> f64 {
    let total: BigInt = terms.weights.iter().sum();
    ratio(terms.weights[i].clone(), total).to_f64().unwrap_or(f64::NAN)
}

/// Whether the line of `ray` surely passes the ball around the box of `points` by, told in f64 with
/// ample room for rounding. Only saves time.
fn surely_missed<const K: usize>(points: &[[f64; K]], ray: &Ray<K>) -> bool {
    let range = |axis: usize| {
        let values = points.iter().map(|p| p[axis]);
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)))
    };
    let ranges: [(f64, f64); K] = std::array::from_fn(range);
    let squared = |v: [f64; K]| v.iter().map(|x| x * x).sum::<f64>();
    let radius_squared = squared(ranges.map(|(low, high)| 0.5 * (high - low)));
    let to_center: [f64; K] =
        std::array::from_fn(|k| 0.5 * ranges[k].0 + 0.5 * ranges[k].1 - ray.origin[k]);
    let length_squared = squared(ray.direction);
    let along: f64 = (0..K).map(|k| to_center[k] * ray.direction[k]).sum();
    // Divided first, so that a square does not vanish where its quotient would not.
    let along = along / length_squared.sqrt();
    let off_squared = squared(to_center) - along * along;
    let largest = ranges.iter().flat_map(|(low, high)| [low.abs(), high.abs()]).fold(0.0, f64::max);
    // Of points so near to each other for where they are, rounding moves the centre.
    let has_center = radius_squared.is_normal() && radius_squared > 1e-20 * largest * largest;
    length_squared.is_normal()
        && has_center
        && off_squared > 1.01 * radius_squared + 1e-9 * squared(to_center)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_of_one_unit_are_not_passed_by() {
        let (one, next) = (1.0_f64, 1.0_f64.next_up());
        let corners = [[one, one, 0.0], [next, one, 0.0], [one, next, 0.0]];
        let ray = Ray::new([next, one, -f64::EPSILON], [0.0, 0.0, 1.0]);
        let hit = exact_triangle_hit(&corners, 0, &ray, HitRule::Touching).expect("at a corner");
        assert_eq!((hit.t.to_f64(), hit.u), (Some(f64::EPSILON), 1.0));
    }
}
