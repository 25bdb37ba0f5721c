//! A line and a segment in the plane.

use super::{ExactHit, Terms, Vector, decide, integers, ratio, share, side_of, surely_missed};
use kdray::Ray;
use kdray::primitives::HitRule;
use num_bigint::BigInt;

/// Where the line of `ray` hits the segment by `rule`, whatever the ray's interval.
pub fn exact_segment_hit(
    ends: &[[f32; 2]; 2],
    id: u32,
    ray: &Ray<2>,
    rule: HitRule,
) -> Option<ExactHit> {
    let ends = ends.map(|p| p.map(f64::from));
    if surely_missed(&ends, ray) {
        return None;
    }
    let [a, b] = ends;
    let [a, b, o, d] = integers([a, b, ray.origin, ray.direction]);
    let ab = b.minus(&a);
    // The front of a segment is its left.
    let normal = ab.left();
    let length_squared = ab.dot(&ab);
    let height = normal.dot(&a.minus(&o));
    let along_normal = normal.dot(&d);
    let weights = |q: &Vector<2>, total: BigInt| {
        let u = q.dot(&ab);
        [total - &u, u]
    };
    let q = o.minus(&a).times(&along_normal).plus(&d.times(&height));
    let plain = weights(&q, &along_normal * &length_squared);
    let gains = |step: &Vector<2>| {
        let gain = step.times(&along_normal).minus(&d.times(&normal.dot(step)));
        weights(&gain, BigInt::ZERO)
    };
    let terms = Terms { along_normal: along_normal.clone(), weights: plain };
    let (terms, crosses) = decide(terms, gains)?;
    let (u, side) = (share(&terms, 1), side_of(&terms));
    let t = ratio(height, terms.along_normal);
    Some(ExactHit { primitive_id: id, t, u, v: 0.0, side, crosses })
        .filter(|hit| hit.counts_for(rule))
}
