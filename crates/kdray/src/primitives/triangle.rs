//! The ray–triangle test: a filter in f64, and exact arithmetic where the filter cannot tell.

use super::{Hit, HitRule, Side};
use crate::exact::{edge_function, turned_edge_sign, volume};
use crate::geometry::Ray;
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
const EDGE_ERROR: f64 = 64.0 * ROUNDING;

/// The largest ratio of the sum of absolute terms to |den| or |T| at which the f64 value is good:
/// 8 roundings leave a relative error below 2^-50 · 512 = 2^-41, and t one below 2^-39.
const GOOD: f64 = 512.0;

/// The hit of `ray` on one triangle, if it counts by `rule` and its t lies in the ray's interval.
///
/// Möller and Trumbore's test (1997) with s = o − a; the signs of U, V and W are those of the real
/// numbers, and t errs by a relative 2^-39 at most, usually by 2^-50. Its sign is exact. A triangle
/// without area or seen edge-on is not hit.
#[inline]
pub fn intersect_triangle(
    corners: &[[f32; 3]; 3],
    id: u32,
    ray: &Ray<3>,
    rule: HitRule,
) -> Option<Hit> {
    let [a, b, c] = corners.map(|p| DVec3::from(p.map(f64::from)));
    let (o, d) = (DVec3::from(ray.origin), DVec3::from(ray.direction));
    let (e1, e2, s) = (b - a, c - a, o - a);
    let p = d.cross(e2);
    let q = s.cross(e1);
    let (u, v, den) = (p.dot(s), q.dot(d), p.dot(e1));
    let w = den - u - v;

    let edges = e1.abs().max(e2.abs()).max_element();
    let (d_scale, s_scale) = (d.abs().element_sum() * edges, edges.max(s.abs().max_element()));
    let scale = d_scale * s_scale;
    let error = EDGE_ERROR * scale;
    let (low, high) = (u.min(v).min(w), u.max(v).max(w));
    // Far from overflow and underflow, of the inner products too, the bound holds, and no value is
    // NaN.
    let bound_holds =
        scale < 1e300 && scale > 1e-250 && d_scale > 1e-200 && edges * s_scale > 1e-200;
    if bound_holds && low < -error && high > error {
        return None;
    }
    if !(bound_holds && (low > error || high < -error)) {
        return intersect_exactly(corners, id, ray, rule);
    }

    let t_times_den = q.dot(e2);
    let good = |value: f64, terms: f64| terms <= GOOD * value.abs() && terms > 1e-280;
    if !good(den, terms(d, e2, e1)) || !good(t_times_den, terms(s, e1, e2)) {
        return intersect_exactly(corners, id, ray, rule);
    }
    hit_at(t_times_den / den, u / den, v / den, den, id, ray)
}

/// The sum of the absolute values of the terms of (a x b) · c.
#[inline]
fn terms(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let (a, b, c) = (a.abs(), b.abs(), c.abs());
    (a.yzx() * b.zxy() + a.zxy() * b.yzx()).dot(c)
}

#[inline]
fn hit_at(t: f64, u: f64, v: f64, den: f64, id: u32, ray: &Ray<3>) -> Option<Hit> {
    let side = if den > 0.0 { Side::Front } else { Side::Back };
    let hit = Hit { t, primitive_id: id, u, v, side };
    (t.is_finite() && ray.interval.contains(t)).then_some(hit)
}

/// The same without any rounding before the final quotients.
#[cold]
#[inline(never)]
fn intersect_exactly(corners: &[[f32; 3]; 3], id: u32, ray: &Ray<3>, rule: HitRule) -> Option<Hit> {
    let [a, b, c] = corners.map(|p| p.map(f64::from));
    let edges = [(b, c), (c, a), (a, b)];
    let [w, u, v] = edges.map(|(p, q)| edge_function(ray, p, q));
    let signs = [w.sign(), u.sign(), v.sign()];
    let den_sign = common_sign(signs)?;
    if rule == HitRule::Crossing {
        let turned = [0, 1, 2].map(|i| turned_edge_sign(ray, edges[i].0, edges[i].1, signs[i]));
        if turned[0] == Ordering::Equal || turned != [turned[0]; 3] {
            return None;
        }
    }
    let mut den = w;
    den.add_all(&u);
    den.add_all(&v);
    let den = den.value();
    let t = volume(ray.origin, [a, b, c]).value().divided_by(den);
    let (u, v) = (u.value().divided_by(den), v.value().divided_by(den));
    let den_side = if den_sign == Ordering::Greater { 1.0 } else { -1.0 };
    hit_at(t, u, v, den_side, id, ray)
}

/// The sign that the numbers which are not zero share; `None` if they do not, or all are zero.
fn common_sign(signs: [Ordering; 3]) -> Option<Ordering> {
    let mut others = signs.into_iter().filter(|&sign| sign != Ordering::Equal);
    let first = others.next()?;
    others.all(|sign| sign == first).then_some(first)
}
