//! A line and a triangle in space.

use super::{ExactHit, Terms, decide, integers, ratio, share, side_of, surely_missed};
use kdray::primitives::HitRule;
use kdray::{Coordinate, Ray};

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
    let (ab, ac) = (b.minus(&a), c.minus(&a));
    let normal = ab.cross(&ac);
    let normal_squared = normal.dot(&normal);
    let height = normal.dot(&a.minus(&o));
    // o + t d lies in the plane for t = height / (normal · d). From a it is at q / (normal · d), of
    // which the part along ab is (q x ac) · normal, and that along ac (ab x q) · normal, over
    // normal².
    let terms = decide(&d, rule, |direction| {
        let along_normal = normal.dot(direction);
        let q = o.minus(&a).times(&along_normal).plus(&direction.times(&height));
        let u = q.cross(&ac).dot(&normal);
        let v = ab.cross(&q).dot(&normal);
        let w = &along_normal * &normal_squared - &u - &v;
        Terms { along_normal, weights: [w, u, v] }
    })?;
    let (u, v, side) = (share(&terms, 1), share(&terms, 2), side_of(&terms));
    Some(ExactHit { primitive_id: id, t: ratio(height, terms.along_normal), u, v, side })
}
