//! A line and a triangle in space.

use super::{ExactHit, Terms, Vector, decide, integers, ratio, share, side_of, surely_missed};
use kdray::primitives::HitRule;
use kdray::{Coordinate, Ray};
use num_bigint::BigInt;

/// Where the line of `ray` hits the triangle by `rule`, whatever the ray's interval.
pub fn exact_triangle_hit<T: Coordinate>(
    corners: &[[T; 3]; 3],
    id: u32,
    ray: &Ray<3>,
    rule: HitRule,
) -> Option<ExactHit> {
    let corners = corners.map(|p| p.map(T::to_f64));
    if surely_missed(&corners, ray) {
        return None;
    }
    let [a, b, c] = corners;
    let [a, b, c, o, d] = integers([a, b, c, ray.origin, ray.direction]);
    hit_of_line([&a, &b, &c], id, (&o, &d)).filter(|hit| hit.counts_for(rule))
}

/// Where the line through two points touches the triangle: t is 0 at the first point and 1 at the second. Their
/// difference need not be an f64.
pub(super) fn exact_touch_between<T: Coordinate>(
    corners: &[[T; 3]; 3],
    id: u32,
    from: [f64; 3],
    to: [f64; 3],
) -> Option<ExactHit> {
    let [a, b, c] = corners.map(|p| p.map(T::to_f64));
    let [a, b, c, from, to] = integers([a, b, c, from, to]);
    hit_of_line([&a, &b, &c], id, (&from, &to.minus(&from)))
}

fn hit_of_line(
    [a, b, c]: [&Vector<3>; 3],
    id: u32,
    (o, d): (&Vector<3>, &Vector<3>),
) -> Option<ExactHit> {
    let (ab, ac) = (b.minus(a), c.minus(a));
    let normal = ab.cross(&ac);
    let normal_squared = normal.dot(&normal);
    let height = normal.dot(&a.minus(o));
    // o + t d lies in the plane for t = height / (normal · d). From a it is at q / (normal · d), of
    // which the part along ab is (q x ac) · normal, and that along ac (ab x q) · normal, over
    // normal².
    let along_normal = normal.dot(d);
    // Moved by s, the line meets the plane elsewhere by s − d · (normal · s) / (normal · d).
    let weights = |q: &Vector<3>, total: BigInt| {
        let (u, v) = (q.cross(&ac).dot(&normal), ab.cross(q).dot(&normal));
        [total - &u - &v, u, v]
    };
    let q = o.minus(a).times(&along_normal).plus(&d.times(&height));
    let plain = weights(&q, &along_normal * &normal_squared);
    let gains = |step: &Vector<3>| {
        let gain = step.times(&along_normal).minus(&d.times(&normal.dot(step)));
        weights(&gain, BigInt::ZERO)
    };
    let terms = Terms { along_normal: along_normal.clone(), weights: plain };
    let (terms, crosses) = decide(terms, gains)?;
    let (u, v, side) = (share(&terms, 1), share(&terms, 2), side_of(&terms));
    Some(ExactHit { primitive_id: id, t: ratio(height, terms.along_normal), u, v, side, crosses })
}
