//! The ray–triangle test: a filter in f64, and exact arithmetic where the filter cannot tell.

use super::{Hit, HitRule, Side};
use crate::exact::{EdgeSigns, Values, hit_t, hit_values, not_vanished};
use crate::geometry::{Coordinate, Interval, Ray, t_above, t_below};
use glam::{DVec3, Vec3Swizzles};
use std::cmp::Ordering;

/// Half the distance from 1 to the next f64.
const ROUNDING: f64 = f64::EPSILON / 2.0;

/// A bound for the error of U, V and W below, in units of D · ē · M with D = |d|₁, ē the largest
/// coordinate of the edges e1, e2 and M the largest of those and of s = o − a.
///
/// U = (d x e2) · s is rounded in e2 and s (once each), in the products and differences of the
/// cross product (twice) and in the dot product (three times): at most 7 roundings on terms that
/// sum to 2·D·|e2|·|s|, so 14. V likewise; den with |e1| in place of |s|. W = den − U − V gathers
/// three of these and two more roundings on each: at most 3·18 = 54.
pub(crate) const EDGE_ERROR: f64 = 64.0 * ROUNDING;

/// A bound for the error of den and T, in units of the sum of the absolute values of their terms:
/// 8 roundings.
pub(crate) const TERM_ERROR: f64 = 8.0 * ROUNDING;

/// The largest relative error at which den and T are good; that of t is below 2^-39 then.
pub(crate) const RELATIVE_ERROR: f64 = 1.0 / (1u64 << 41) as f64;

/// The largest error of an edge function, relative to den, at which u and v are good.
pub(crate) const BARYCENTRIC_ERROR: f64 = 1.0 / (1u64 << 31) as f64;

/// The hit of `ray` on one triangle, if it counts by `rule` and its t lies in the ray's interval.
///
/// Möller and Trumbore's test (1997) with s = o − a; the signs of U, V and W are those of the real
/// numbers, and t errs by a relative 2^-39 at most, usually by 2^-50, and near the smallest f64 by one of
/// these. Its sign is exact, down to the smallest f64; beyond the largest f64 there is no hit. u and v err by 2^-30 at most. A
/// triangle without area or seen edge-on is not hit.
///
/// Corners in f32 and the same in f64 give the same hit. The ray must be one that [`Ray::check`] passes, as queries of
/// scenes make sure; of others the answer means nothing.
#[inline(always)]
pub fn intersect_triangle<T: Coordinate>(
    corners: &[[T; 3]; 3],
    id: u32,
    ray: &Ray<3>,
    rule: HitRule,
) -> Option<Hit> {
    let [a, b, c] = corners;
    let (a, b, c) = (in_f64(a), in_f64(b), in_f64(c));
    let (o, d) = (DVec3::from(ray.origin), DVec3::from(ray.direction));
    let (e1, e2, s) = (b - a, c - a, o - a);
    let p = d.cross(e2);
    let q = s.cross(e1);
    let (u, v, den) = (p.dot(s), q.dot(d), p.dot(e1));
    let w = den - u - v;

    // The filter. Far from overflow and underflow, of the inner products too, the error bound
    // holds, and no value is NaN. D · ē bounds p, and ē · M bounds q.
    let edges = e1.abs().max(e2.abs()).max_element();
    let (d_scale, s_scale) = (d.abs().element_sum() * edges, edges.max(s.abs().max_element()));
    let (scale, q_scale) = (d_scale * s_scale, edges * s_scale);
    let bound_holds =
        scale < 1e300 && q_scale < 1e300 && scale > 1e-250 && d_scale > 1e-200 && q_scale > 1e-200;
    let error = if bound_holds { EDGE_ERROR * scale } else { f64::INFINITY };
    let (low, high) = (u.min(v).min(w), u.max(v).max(w));
    if low < -error && high > error {
        return None;
    }
    let surely_inside = low > error || high < -error;
    if !surely_inside && !is_hit_exactly([w, u, v], error, corners, ray, rule) {
        return None;
    }

    // The terms of den sum to 2·D·ē² at most, those of T to 6·ē²·M; both may be far less.
    let volume = q.dot(e2);
    let den_size = den.abs();
    let is_good = |terms: f64| (TERM_ERROR / RELATIVE_ERROR) * terms <= den_size;
    let trusted = bound_holds
        && error <= BARYCENTRIC_ERROR * den_size
        && (is_good(2.0 * d_scale * edges) || is_good(terms(d, e2, e1)));
    let (t, u, v, front) = if trusted {
        let most_terms = 6.0 * q_scale * edges;
        let error = t_error(most_terms, edges);
        let t = if error <= RELATIVE_ERROR * volume.abs() && most_terms < 1e300 {
            not_vanished(volume / den)
        } else {
            t_carefully(corners, ray, den, volume, (terms(s, e1, e2), edges))?
        };
        let inverse = 1.0 / den;
        (t, (u * inverse).clamp(0.0, 1.0), (v * inverse).clamp(0.0, 1.0), den > 0.0)
    } else {
        values_exactly(corners, ray)
    };
    let side = if front { Side::Front } else { Side::Back };
    // Plus zero, as -0 becomes 0 by that: of zeros of either sign min and max may give either.
    let (u, v) = (u + 0.0, v.min(1.0 - u) + 0.0);
    let hit = Hit { t, primitive_id: id, u, v, side };
    (t.is_finite() && ray.interval.contains(t)).then_some(hit)
}

/// The same point. Not by `map`, which is not always compiled into the kernels.
#[inline(always)]
fn in_f64<T: Coordinate>(&[x, y, z]: &[T; 3]) -> DVec3 {
    DVec3::new(x.to_f64(), y.to_f64(), z.to_f64())
}

/// How far T may be off, from the sum of its terms' absolute values, and from ē: what underflows in q is multiplied by
/// an edge.
#[inline]
fn t_error(terms: f64, edges: f64) -> f64 {
    TERM_ERROR * terms + f64::MIN_POSITIVE * (1.0 + edges)
}

/// t from a den that is good and a T that may not be; `None` if it surely is not in the interval.
#[inline(never)]
fn t_carefully<T: Coordinate>(
    corners: &[[T; 3]; 3],
    ray: &Ray<3>,
    den: f64,
    volume: f64,
    (terms, edges): (f64, f64),
) -> Option<f64> {
    let t_error = t_error(terms, edges);
    // The filter bounds ē²·M by nothing: where that overflows, the ends are infinite or NaN.
    let in_range = terms < 1e300;
    let ends = ((volume - t_error) / den, (volume + t_error) / den);
    let Interval { t_min, t_max } = ray.interval;
    let is_outside = t_above(ends.0.max(ends.1)) < t_min || t_below(ends.0.min(ends.1)) > t_max;
    if in_range && is_outside {
        return None;
    }
    let is_good = in_range && t_error <= RELATIVE_ERROR * volume.abs();
    Some(if is_good { not_vanished(volume / den) } else { t_exactly(corners, ray, den) })
}

/// The sum of the absolute values of the terms of (a x b) · c.
#[inline]
fn terms(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let (a, b, c) = (a.abs(), b.abs(), c.abs());
    (a.yzx() * b.zxy() + a.zxy() * b.yzx()).dot(c)
}

/// Whether the triangle is hit, from the edge functions W, U, V where their signs are sure, and
/// without rounding where they are not.
#[cold]
#[inline(never)]
fn is_hit_exactly<T: Coordinate>(
    values: [f64; 3],
    error: f64,
    corners: &[[T; 3]; 3],
    ray: &Ray<3>,
    rule: HitRule,
) -> bool {
    if !are_finite(corners) {
        return false;
    }
    let edges = EdgeSigns::new(ray, corners.map(|p| p.map(T::to_f64)));
    let Some(signs) = agreeing_signs(values, error, &edges) else { return false };
    if rule == HitRule::Touching {
        return true;
    }
    let moved = [0, 1, 2].map(|i| edges.moved_sign(i, signs[i]));
    moved[0] != Ordering::Equal && moved == [moved[0]; 3]
}

/// The signs of W, U and V, unless two of them are opposite or all are zero. Those that are not sure are found one by one,
/// as long as they matter.
fn agreeing_signs(values: [f64; 3], error: f64, edges: &EdgeSigns<'_>) -> Option<[Ordering; 3]> {
    let is_sure = |i: usize| values[i].abs() > error;
    let sure = |i: usize| if is_sure(i) { values[i].total_cmp(&0.0) } else { Ordering::Equal };
    let mut signs = [0, 1, 2].map(sure);
    for i in [0, 1, 2].into_iter().filter(|&i| !is_sure(i)) {
        signs[i] = edges.sign(i);
        if signs.contains(&Ordering::Less) && signs.contains(&Ordering::Greater) {
            return None;
        }
    }
    (signs != [Ordering::Equal; 3]).then_some(signs)
}

/// t from a den that is good, where T has lost too many digits: near the origin of the ray.
#[cold]
#[inline(never)]
fn t_exactly<T: Coordinate>(corners: &[[T; 3]; 3], ray: &Ray<3>, den: f64) -> f64 {
    hit_t(ray, corners.map(|p| p.map(T::to_f64)), den)
}

/// t, u, v and whether the front is hit, from T, U, V and den rounded once each.
#[cold]
#[inline(never)]
fn values_exactly<T: Coordinate>(corners: &[[T; 3]; 3], ray: &Ray<3>) -> Values {
    if !are_finite(corners) {
        return (f64::NAN, 0.0, 0.0, false);
    }
    hit_values(ray, corners.map(|p| p.map(T::to_f64)))
}

/// Whether these are corners of a triangle at all. Those in a tree file that was not verified need not
/// be; none of them is hit.
fn are_finite<T: Coordinate>(corners: &[[T; 3]; 3]) -> bool {
    corners.as_flattened().iter().all(|x| x.to_f64().is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [[f32; 3]; 3] = [[0.0, 0.0, 5.0], [4.0, 0.0, 5.0], [0.0, 4.0, 5.0]];
    const UP: [f64; 3] = [0.0, 0.0, 1.0];

    fn hit_from(origin: [f64; 3], rule: HitRule) -> Option<Hit> {
        intersect_triangle(&CORNERS, 7, &Ray::new(origin, UP), rule)
    }

    #[test]
    fn a_point_inside_has_its_barycentrics() {
        let hit = hit_from([1.0, 2.0, 0.0], HitRule::Touching).unwrap();
        let expected = Hit { t: 5.0, primitive_id: 7, u: 0.25, v: 0.5, side: Side::Back };
        assert_eq!(hit, expected);
        let from_above = Ray::new([1.0, 2.0, 9.0], [0.0, 0.0, -2.0]);
        let hit = intersect_triangle(&CORNERS, 7, &from_above, HitRule::Crossing).unwrap();
        assert_eq!(hit, Hit { t: 2.0, side: Side::Front, ..expected });
    }

    #[test]
    fn edges_and_vertices_belong_to_the_triangle() {
        for origin in [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [2.0, 2.0, 0.0]] {
            assert!(hit_from(origin, HitRule::Touching).is_some(), "{origin:?}");
        }
        let beside = f64::from_bits(1);
        assert_eq!(hit_from([-beside, 1.0, 0.0], HitRule::Touching), None);
        assert!(hit_from([beside, 1.0, 0.0], HitRule::Touching).is_some());
    }

    #[test]
    fn a_fan_around_a_vertex_is_crossed_once() {
        let ring = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        let ray = Ray::new([0.0; 3], UP);
        let crossed = (0..4).filter(|&i| {
            let (p, q): ([f32; 2], [f32; 2]) = (ring[i], ring[(i + 1) % 4]);
            let fan = [[0.0, 0.0, 2.0], [p[0], p[1], 2.0], [q[0], q[1], 2.0]];
            intersect_triangle(&fan, 0, &ray, HitRule::Crossing).is_some()
        });
        assert_eq!(crossed.count(), 1);
    }

    #[test]
    fn what_has_no_area_or_is_seen_edge_on_is_missed() {
        let needle = [[0.0, 0.0, 1.0], [0.0, 0.0, 2.0], [0.0, 0.0, 3.0]];
        let ray = Ray::new([0.0; 3], UP);
        let in_plane = Ray::new([1.0, 1.0, 5.0], [1.0, 0.0, 0.0]);
        for rule in [HitRule::Touching, HitRule::Crossing] {
            assert_eq!(intersect_triangle(&needle, 0, &ray, rule), None);
            assert_eq!(intersect_triangle(&CORNERS, 0, &in_plane, rule), None);
        }
    }

    #[test]
    fn corners_that_are_not_finite_are_missed() {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            for place in 0..9 {
                let mut corners = CORNERS;
                corners.as_flattened_mut()[place] = bad;
                for origin in [[1.0, 1.0, 0.0], [0.0; 3], [2.0, 2.0, 5.0], [1.0, 0.0, 5.0]] {
                    for direction in [UP, [1.0, 0.0, 0.0], [0.3, 0.4, 0.5]] {
                        let ray = Ray::new(origin, direction);
                        for rule in [HitRule::Touching, HitRule::Crossing] {
                            assert_eq!(intersect_triangle(&corners, 0, &ray, rule), None);
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn t_keeps_its_digits_where_terms_cancel() {
        // The origin lies 2^-80 below a plane a million away from the coordinate origin.
        let k = 1_048_576.0_f32;
        let corners = [[k, 0.0, 0.0], [0.0, k, 0.0], [0.0, 0.0, k]];
        let third = f64::from(k) / 4.0;
        let origin = [third, third, 2.0 * third - 1e-10];
        let hit = intersect_triangle(&corners, 0, &Ray::new(origin, UP), HitRule::Touching);
        let exact = f64::from(k) - third - third - origin[2];
        assert_eq!(hit.unwrap().t, exact);
        assert!(exact > 0.0);
    }

    #[test]
    fn numbers_out_of_range_of_the_filter_are_decided_too() {
        for scale in [1e-38_f32, 1e-30, 1e30, 1e38] {
            let corners = CORNERS.map(|p| p.map(|x| x * (scale / 8.0)));
            let at = |x: f64| x * f64::from(scale / 8.0);
            for length in [1e-300, 1e-200, 1.0, 1e200, 1e300] {
                let ray = Ray::new([at(1.0), at(1.0), 0.0], [0.0, 0.0, length]);
                let hit = intersect_triangle(&corners, 0, &ray, HitRule::Touching);
                let t = at(5.0) / length;
                match hit {
                    Some(hit) => {
                        let error = (1e-6 * t).max(f64::from_bits(1));
                        assert!((hit.t - t).abs() <= error, "{scale} {length}");
                    }
                    None => assert!(t > 1e307, "{scale} {length}"),
                }
            }
        }
    }
}
