//! The point of a triangle that is nearest to a given one.

use super::range::in_range;
use crate::exact::{is_on_triangle, not_vanished};
use glam::DVec3;

/// The point of a surface that is nearest to a given point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosestPoint {
    /// The nearest point, rounded; the given point where the distance is zero, or less than 2^-46 of the way to the
    /// triangle's farthest corner.
    pub point: [f64; 3],
    /// How far it is from the given point. Zero exactly where that lies on the triangle; else it
    /// errs by 2^-46 of the distance from there to the triangle's farthest corner at most, usually
    /// by 2^-52; by 2^-44 in triangles whose angle at the first corner has a sine below 2^-40, which f64 vertices may
    /// have; near the smallest f64 by one of these.
    pub distance: f64,
    /// The index of the triangle.
    pub primitive_id: u32,
    /// Barycentric weight of the triangle's second vertex b: the point is (1−u−v)·a + u·b + v·c.
    pub u: f64,
    /// Barycentric weight of the triangle's third vertex c.
    pub v: f64,
}

impl ClosestPoint {
    /// The order of candidates: by distance, and for equal distances by primitive id.
    #[inline]
    pub fn precedes(&self, other: &Self) -> bool {
        (self.distance, self.primitive_id) < (other.distance, other.primitive_id)
    }
}

/// A bound for the error of a distance, in units of the distance to the farthest corner M.
///
/// The distance is the length of s − u·e1 − v·e2, s from a corner to the point, whatever u and v
/// are, so it is too small by rounding alone: s, e1 and e2 once each, two products and two
/// differences, on |s| ≤ M and |e| ≤ 2·M, in each of three components: at most 35 roundings of M,
/// and 3 more of the length. It is too large by rounding, and by what u and v are off.
pub(crate) const DISTANCE_ERROR: f64 = 64.0 * f64::EPSILON;

/// What is nearer than this, in the same units, is tested without rounding: of a point on a triangle that is so thin that
/// its normal is all rounding, the distance may come out as large as 2^-45.
const MAYBE_ON_TRIANGLE: f64 = 1.0 / (1_u64 << 40) as f64;

/// The point of a triangle that is nearest to `point`, whose coordinates are finite.
///
/// The triangle is a closed set; one without area is the segment, or the point, that its corners
/// span. Triangles that share a vertex or an edge find the same distance to it, to the last bit, unless the foot of the
/// perpendicular lies in them. It is the largest f64 at most.
pub fn closest_on_triangle(point: [f64; 3], corners: [[f64; 3]; 3], id: u32) -> ClosestPoint {
    let ([p, a, b, c], scale) = in_range([point, corners[0], corners[1], corners[2]]);
    let nearest = nearest_on(p, [a, b, c]);
    let length = nearest.way.length();
    let distance = not_vanished(scale.length_back(length)).min(f64::MAX);
    let size = (p - a).length_squared().max((p - b).length_squared()).max((p - c).length_squared());
    let farthest = size.sqrt();
    if length <= MAYBE_ON_TRIANGLE * farthest && is_on_triangle(point, corners) {
        return nearest.reported(point, 0.0, id);
    }
    if length <= DISTANCE_ERROR * farthest {
        return nearest.reported(point, distance, id);
    }
    let place = a + (nearest.u * (b - a) + nearest.v * (c - a));
    // Of the largest numbers rounding may leave none.
    let place = scale.point_back(place).clamp(DVec3::MIN, DVec3::MAX);
    nearest.reported(place.into(), distance, id)
}

/// A nearest point by its weights, and the way from it to the given one.
#[derive(Clone, Copy)]
struct Nearest {
    u: f64,
    v: f64,
    way: DVec3,
}

impl Nearest {
    fn is_nearer_than(&self, other: &Self) -> bool {
        self.way.length_squared() < other.way.length_squared()
    }

    fn reported(self, point: [f64; 3], distance: f64, primitive_id: u32) -> ClosestPoint {
        ClosestPoint { point, distance, primitive_id, u: self.u, v: self.v }
    }
}

/// The foot of the perpendicular from `p`, if it was found in the triangle.
///
/// With n = e1 x e2, s = u·e1 + v·e2 + w·n is solved for u and v. In a thin triangle n is off, in length and direction,
/// by 2^-52 over the sine of the angle at a. To solve again for what is left of s makes up for the length, not
/// for the direction: the foot stays off by that share of the height. So of a thin triangle it may be no foot at all,
/// but it is a point, whose distance is known; the nearest of those that came up is taken.
fn in_face(p: DVec3, [a, b, c]: [DVec3; 3]) -> Option<Foot> {
    const ROUNDS: usize = 6;
    const ENOUGH: f64 = 1.0 / (1_u64 << 49) as f64;
    const LEAST_SINE: f64 = 1.0 / 8.0;
    let (e1, e2, s) = (b - a, c - a, p - a);
    let n = e1.cross(e2);
    let sizes = [e1.length_squared(), e2.length_squared()];
    let (for_u, for_v, scale) = (e2.cross(n), n.cross(e1), 1.0 / n.length_squared());
    if !scale.is_finite() {
        return None;
    }
    let (mut u, mut v, mut way) = (0.0, 0.0, s);
    let mut nearest: Option<Nearest> = None;
    let enough = ENOUGH * ENOUGH * s.length_squared().max(sizes[0]).max(sizes[1]);
    for _ in 0..ROUNDS {
        let (du, dv) = (way.dot(for_u) * scale, way.dot(for_v) * scale);
        (u, v) = (u + du, v + dv);
        way = s - (u * e1 + v * e2);
        let found = Nearest { u, v, way };
        let is_in_face = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        if is_in_face && nearest.is_none_or(|nearest| found.is_nearer_than(&nearest)) {
            nearest = Some(found);
        }
        if (du * e1 + dv * e2).length_squared() <= enough {
            break;
        }
    }
    let is_sure = n.length_squared() >= LEAST_SINE * LEAST_SINE * sizes[0] * sizes[1];
    nearest.map(|nearest| Foot { nearest, is_sure })
}

/// What may be the foot of a perpendicular.
struct Foot {
    nearest: Nearest,
    /// Whether no point of an edge can be nearer.
    is_sure: bool,
}

/// The nearest point of the closed triangle.
fn nearest_on(p: DVec3, corners: [DVec3; 3]) -> Nearest {
    let foot = in_face(p, corners);
    if let Some(Foot { nearest, is_sure: true }) = foot {
        return nearest;
    }
    let border = on_border(p, corners);
    match foot {
        Some(Foot { nearest, .. }) if nearest.is_nearer_than(&border) => nearest,
        _ => border,
    }
}

/// The nearest point of the three edges.
fn on_border(p: DVec3, [a, b, c]: [DVec3; 3]) -> Nearest {
    let edge = |from, to| on_edge(p, from, to);
    let ((on_ab, ab), (on_bc, bc), (on_ca, ca)) = (edge(a, b), edge(b, c), edge(c, a));
    let mut nearest = Nearest { u: on_ab, v: 0.0, way: ab };
    for other in
        [Nearest { u: 1.0 - on_bc, v: on_bc, way: bc }, Nearest { u: 0.0, v: 1.0 - on_ca, way: ca }]
    {
        if other.is_nearer_than(&nearest) {
            nearest = other;
        }
    }
    nearest
}

/// How far along the edge the nearest point lies, from 0 at `a` to 1 at `b`, and the way from it to
/// `p`. Both triangles at an edge compute it from the same end, and so alike.
fn on_edge(p: DVec3, a: DVec3, b: DVec3) -> (f64, DVec3) {
    if a.to_array() > b.to_array() {
        let (share, way) = on_edge(p, b, a);
        return (1.0 - share, way);
    }
    let (edge, from_a, from_b) = (b - a, p - a, p - b);
    let along = from_a.dot(edge);
    if along <= 0.0 {
        (0.0, from_a)
    } else if from_b.dot(edge) >= 0.0 {
        (1.0, from_b)
    } else {
        let share = (along / edge.length_squared()).min(1.0);
        (share, from_a - share * edge)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [[f64; 3]; 3] = [[0.0, 0.0, 5.0], [4.0, 0.0, 5.0], [0.0, 4.0, 5.0]];

    fn nearest(point: [f64; 3]) -> ClosestPoint {
        closest_on_triangle(point, CORNERS, 3)
    }

    #[test]
    fn each_region_has_its_nearest_point() {
        for (point, place, u, v) in [
            ([1.0, 2.0, 8.0], [1.0, 2.0, 5.0], 0.25, 0.5),
            ([1.0, 2.0, 2.0], [1.0, 2.0, 5.0], 0.25, 0.5),
            ([-3.0, -4.0, 5.0], [0.0, 0.0, 5.0], 0.0, 0.0),
            ([9.0, 0.0, 5.0], [4.0, 0.0, 5.0], 1.0, 0.0),
            ([0.0, 9.0, 6.0], [0.0, 4.0, 5.0], 0.0, 1.0),
            ([1.0, -7.0, 5.0], [1.0, 0.0, 5.0], 0.25, 0.0),
            ([-7.0, 3.0, 5.0], [0.0, 3.0, 5.0], 0.0, 0.75),
            ([5.0, 5.0, 5.0], [2.0, 2.0, 5.0], 0.5, 0.5),
        ] {
            let found = nearest(point);
            let length = DVec3::from(point).distance(place.into());
            assert_eq!((found.point, found.u, found.v), (place, u, v), "{point:?}");
            assert_eq!((found.distance, found.primitive_id), (length, 3), "{point:?}");
        }
    }

    #[test]
    fn the_distance_is_zero_exactly_on_the_triangle() {
        for point in [[1.0, 1.0, 5.0], [2.0, 2.0, 5.0], [4.0, 0.0, 5.0], [1.0, 3.0, 5.0]] {
            assert_eq!((nearest(point).distance, nearest(point).point), (0.0, point));
            for axis in 0..3 {
                for step in [f64::next_up, f64::next_down] {
                    let mut beside = point;
                    beside[axis] = step(beside[axis]);
                    let on = is_on_triangle(beside, CORNERS);
                    assert_eq!(nearest(beside).distance == 0.0, on, "{beside:?}");
                }
            }
        }
    }

    #[test]
    fn triangles_without_area_are_segments_and_points() {
        let line = [[0.0; 3], [4.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
        let found = closest_on_triangle([3.0, 4.0, 0.0], line, 0);
        assert_eq!((found.point, found.distance), ([3.0, 0.0, 0.0], 4.0));
        let found = closest_on_triangle([3.0, 4.0, 0.0], [[0.0; 3]; 3], 0);
        assert_eq!((found.point, found.distance), ([0.0; 3], 5.0));
    }

    #[test]
    fn points_as_far_as_they_come_have_distances() {
        for far in [1e100, 1e149, 1e151, 1e300, f64::MAX] {
            let found = nearest([far, -far, 0.0]);
            let expected = (far * std::f64::consts::SQRT_2).min(f64::MAX);
            assert!((found.distance / expected - 1.0).abs() < 1e-12, "{far}: {found:?}");
        }
    }

    #[test]
    fn triangles_of_any_size_are_alike() {
        for (point, u, v) in [([1.0, 2.0, 8.0], 0.25, 0.5), ([5.0, 5.0, 5.0], 0.5, 0.5)] {
            let distance = nearest(point).distance;
            for exponent in [-1050, -1000, -700, -400, -230, 230, 400, 700, 1000, 1020] {
                let times =
                    |x: f64| x * 2.0_f64.powi(exponent / 2) * 2.0_f64.powi(exponent - exponent / 2);
                let corners = CORNERS.map(|p| p.map(times));
                let found = closest_on_triangle(point.map(times), corners, 3);
                assert_eq!((found.u, found.v), (u, v), "2^{exponent}");
                let error = (found.distance - times(distance)).abs();
                assert!(error <= 1e-15 * found.distance + 5e-324, "2^{exponent}: {found:?}");
            }
        }
        let corners = [[f64::MAX; 3], [f64::MIN; 3], [f64::MAX, f64::MIN, f64::MAX]];
        let found = closest_on_triangle([f64::MIN, f64::MAX, f64::MIN], corners, 0);
        assert!(found.distance == f64::MAX && found.point.iter().all(|x| x.is_finite()));
    }
}
