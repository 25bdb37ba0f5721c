//! What kdray answers against what is right.

use super::ExactHit;
use super::integers::rational;
use kdray::{Hit, Interval, Ray};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Signed;
use std::cmp::Ordering;

/// The documented relative error of t is at most 2 to the power of minus this, but near the smallest f64.
const T_BITS: usize = 39;

/// The documented error of u and v.
const UV_ERROR: f64 = 1.0 / (1 << 30) as f64;

/// Compares all hits, in order, with the exact ones on the line of the ray.
///
/// The same primitives must be hit, but for those whose t is within the error bound of an end of
/// the interval; t, u, v and the side must be right; the order must be by t, where the exact t of
/// two hits are farther apart than the error bound.
///
/// # Errors
/// A sentence about the first difference.
pub fn agrees_on_all<const K: usize>(
    exact: &[ExactHit],
    found: &[Hit],
    ray: &Ray<K>,
) -> Result<(), String> {
    for hit in exact {
        let times = found.iter().filter(|f| f.primitive_id == hit.primitive_id).count();
        let right = match place(&hit.t, ray.interval) {
            Place::Inside => times == 1,
            Place::Outside => times == 0,
            Place::AtEnd => times <= 1,
        };
        if !right {
            return Err(format!("primitive {} is found {times} times", describe(hit)));
        }
    }
    let matched = found.iter().map(|hit| check_hit(exact, hit)).collect::<Result<Vec<_>, _>>()?;
    for (pair, hits) in matched.windows(2).zip(found.windows(2)) {
        if !hits[0].precedes(&hits[1]) {
            return Err(format!("{:?} stands before {:?}", hits[0], hits[1]));
        }
        if pair[0].t > pair[1].t && !close(&pair[0].t, &pair[1].t) {
            return Err(format!("{} stands before {}", describe(pair[0]), describe(pair[1])));
        }
    }
    Ok(())
}

/// Compares a closest hit with the exact hits on the line of the ray: none of them may be nearer
/// by more than the error bound.
///
/// # Errors
/// A sentence about the difference.
pub fn agrees_on_closest<const K: usize>(
    exact: &[ExactHit],
    found: Option<&Hit>,
    ray: &Ray<K>,
) -> Result<(), String> {
    let inside = exact.iter().filter(|hit| place(&hit.t, ray.interval) == Place::Inside);
    let nearest = inside.min_by(|a, b| a.t.cmp(&b.t));
    let Some(found) = found else {
        return nearest.map_or(Ok(()), |hit| Err(format!("{} is missed", describe(hit))));
    };
    let matched = check_hit(exact, found)?;
    if place(&matched.t, ray.interval) == Place::Outside {
        return Err(format!("{} lies outside of {:?}", describe(matched), ray.interval));
    }
    match nearest {
        Some(nearest) if nearest.t < matched.t && !close(&nearest.t, &matched.t) => {
            Err(format!("{} is nearer than {}", describe(nearest), describe(matched)))
        }
        _ => Ok(()),
    }
}

/// The exact hit that `found` is, if its numbers are right.
fn check_hit<'a>(exact: &'a [ExactHit], found: &Hit) -> Result<&'a ExactHit, String> {
    let Some(hit) = exact.iter().find(|hit| hit.primitive_id == found.primitive_id) else {
        return Err(format!("{found:?} is no hit"));
    };
    let uv_right = (hit.u - found.u).abs() <= UV_ERROR && (hit.v - found.v).abs() <= UV_ERROR;
    if !found.t.is_finite() || !close(&hit.t, &rational(found.t)) {
        return Err(format!("t of {found:?} is wrong: {}", describe(hit)));
    }
    if !uv_right || hit.side != found.side {
        return Err(format!("u, v or side of {found:?} are wrong: {}", describe(hit)));
    }
    Ok(hit)
}

/// Whether two numbers differ by no more than the error bound of the first.
fn close(exact: &BigRational, other: &BigRational) -> bool {
    (exact - other).abs() <= error_bound(exact)
}

/// Of what is nearly nothing, the distance of two f64.
fn error_bound(t: &BigRational) -> BigRational {
    (t.abs() / (BigInt::from(1) << T_BITS)).max(rational(f64::from_bits(1)))
}

/// How a t lies to an interval whose ends are told apart no better than the error bound allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    Inside,
    AtEnd,
    Outside,
}

fn place(t: &BigRational, interval: Interval) -> Place {
    let after_start = compare(t, interval.t_min);
    let before_end = compare(t, interval.t_max).reverse();
    let near_end = |end: f64| end.is_finite() && close(t, &rational(end));
    let exactly_at = |end: f64| end.is_finite() && *t == rational(end);
    let inside = after_start != Ordering::Less && before_end != Ordering::Less;
    // An end of zero leaves no doubt: the sign of t is exact, and so is a t of zero.
    let doubtful = [interval.t_min, interval.t_max]
        .into_iter()
        .any(|end| near_end(end) && !(end == 0.0 && exactly_at(end)));
    match (doubtful, inside) {
        (true, _) => Place::AtEnd,
        (false, true) => Place::Inside,
        (false, false) => Place::Outside,
    }
}

fn compare(t: &BigRational, end: f64) -> Ordering {
    if end.is_finite() {
        t.cmp(&rational(end))
    } else if end > 0.0 {
        Ordering::Less
    } else {
        Ordering::Greater
    }
}

fn describe(hit: &ExactHit) -> String {
    use num_traits::ToPrimitive;
    let t = hit.t.to_f64().unwrap_or(f64::NAN);
    let ExactHit { primitive_id, u, v, side, .. } = hit;
    format!("primitive {primitive_id} at exactly t = {t:e}, u = {u}, v = {v}, {side:?}")
}
