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
mod triangle;

pub use compare::{agrees_on_all, agrees_on_closest};
pub use point::{
    exact_distance_squared, exactly_contains, is_between, is_distance, is_exactly_visible,
};
pub use segment::exact_segment_hit;
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
}

/// What decides whether a line meets a primitive: numbers that are linear in the line's origin.
struct Terms<const N: usize> {
    /// Zero for a direction parallel to the primitive; negative for one from its front.
    along_normal: BigInt,
    /// The barycentric weights of the meeting point times `along_normal` and a positive number.
    weights: [BigInt; N],
}

/// Whether the line hits by `rule`, and if so its terms.
///
/// The moved ray has the origin o + (ε, ε², ε³), in 2-D without the last. Since weights are linear in the
/// origin, what they gain by a step along an axis, as `gains` says, is the coefficient of that power of ε.
fn decide<const K: usize, const N: usize>(
    plain: Terms<N>,
    rule: HitRule,
    gains: impl Fn(&Vector<K>) -> [BigInt; N],
) -> Option<Terms<N>> {
    let side = sign(&plain.along_normal);
    if side == Sign::NoSign {
        return None;
    }
    let moves: Vec<[BigInt; N]> = match rule {
        HitRule::Touching => Vec::new(),
        HitRule::Crossing => (0..K).map(|axis| gains(&Vector::step(axis))).collect(),
    };
    let hit = (0..N).all(|i| {
        let all = std::iter::once(&plain.weights).chain(&moves);
        match all.map(|weights| sign(&weights[i])).find(|&sign| sign != Sign::NoSign) {
            Some(first) => first == side,
            None => rule == HitRule::Touching,
        }
    });
    hit.then_some(plain)
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
    length_squared.is_normal()
        && off_squared > 1.01 * radius_squared + 1e-9 * squared(to_center)
        && radius_squared.is_normal()
}
