//! How large a triangle looks from a point.

use super::range::in_range;
use crate::exact::{cross_component, side_of_plane};
use glam::DVec3;
use std::cmp::Ordering;
use std::f64::consts::PI;

/// Products of three shorter lengths may underflow.
const LEAST: f64 = 1e-100;

/// Beside an edge, where numerator and denominator of the tangent are smaller than this, in units of the product of
/// the lengths that each is made of, they have lost too many digits: they are off by some 2^-50 of it.
const BESIDE_EDGE: f64 = 1.0 / (1_u64 << 20) as f64;

/// The solid angle that a triangle covers seen from `point`, as a share of the whole sphere:
/// positive from behind, negative from the front, zero in the triangle's plane.
///
/// Van Oosterom and Strackee's formula (1983). Where a quarter of the sphere or more is covered, near a
/// triangle, the share leaps from a half to minus a half at the plane: there its sign is exact, and it is zero in
/// the plane exactly, for the side that the point is on is decided without rounding. So it is close to an edge, where
/// all shares meet. Farther away it goes through zero without a leap, and in the plane may be off by rounding, either way.
pub fn solid_angle(point: [f64; 3], corners: [[f64; 3]; 3]) -> f64 {
    let ([p, places @ ..], _) = in_range([point, corners[0], corners[1], corners[2]]);
    let mut ways = places.map(|place| place - p);
    if ways.iter().any(|way| way.length_squared() < LEAST * LEAST) {
        // How far away corners are does not matter.
        ways = ways.map(unit);
    }
    let [a, b, c] = ways;
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let volume = a.dot(b.cross(c));
    let product = la * lb * lc;
    let below = product + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    let is_beside_edge = volume.abs().max(below.abs()) < BESIDE_EDGE * product;
    let share = if is_beside_edge { beside_edge(p, places) } else { share(volume, below) };
    if below > BESIDE_EDGE * product {
        return share;
    }
    match side_of_plane(point, corners) {
        Ordering::Equal => 0.0,
        Ordering::Less => share.abs(),
        Ordering::Greater => -share.abs(),
    }
}

/// Half the angle, over pi, from what its tangent is the quotient of. A quarter of the sphere is covered where
/// `below` is zero.
fn share(volume: f64, below: f64) -> f64 {
    volume.atan2(below) / (2.0 * PI)
}

/// The share of a triangle, up to its sign, for a point so close to an edge that all digits of `volume` and of `below`
/// cancel.
///
/// Seen from there, the ends of that edge are a and b in nearly opposite directions, of length one here like c. What
/// is small in both is m = a x b, and that is known without rounding from the corners as they are. With e = b − a it is
/// a + b = 2·(e x m) / |e|², so that below = (m · m + c · (e x m)) / (1 − a · b).
#[cold]
fn beside_edge(p: DVec3, corners: [DVec3; 3]) -> f64 {
    let ways = corners.map(|corner| corner - p);
    let opposite = |i: usize| unit(ways[i]).dot(unit(ways[(i + 1) % 3]));
    let first = (0..3).min_by(|&i, &j| opposite(i).total_cmp(&opposite(j))).unwrap_or(0);
    let [a, b, c] = [0, 1, 2].map(|i| unit(ways[(first + i) % 3]));
    let m = cross(p, corners[first], corners[(first + 1) % 3]);
    let below = (m.dot(m) + c.dot((b - a).cross(m))) / (1.0 - a.dot(b));
    share(c.dot(m), below)
}

/// a x b of the directions to a and b from p, as if of length one; each component errs by some units in its last place.
fn cross(p: DVec3, a: DVec3, b: DVec3) -> DVec3 {
    let lengths = [a, b].map(|end| end.distance(p).max(f64::MIN_POSITIVE));
    let [p, a, b] = [p, a, b].map(|place| place.to_array());
    let component = |axes| {
        let exact = cross_component(p, a, b, axes).value();
        // The shorter one first, lest it underflow.
        exact.divided_by(lengths[0].min(lengths[1]).into()) / lengths[0].max(lengths[1])
    };
    DVec3::new(component((1, 2)), component((2, 0)), component((0, 1)))
}

/// The same direction of length one, of a vector of any length; of none, zero.
#[cold]
fn unit(way: DVec3) -> DVec3 {
    (way / way.abs().max_element().max(f64::MIN_POSITIVE)).normalize_or_zero()
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    #[test]
    fn an_octant_is_an_eighth() {
        assert!((solid_angle([0.0; 3], CORNERS) - 0.125).abs() < 1e-15);
        let turned = [CORNERS[1], CORNERS[0], CORNERS[2]];
        assert!((solid_angle([0.0; 3], turned) + 0.125).abs() < 1e-15);
    }

    #[test]
    fn close_to_the_inside_it_is_half_of_the_sphere_on_either_side() {
        let on = [0.25, 0.25, 0.5];
        assert_eq!(solid_angle(on, CORNERS), 0.0);
        for (z, share) in [(0.5_f64.next_up(), -0.5), (0.5_f64.next_down(), 0.5)] {
            assert!((solid_angle([0.25, 0.25, z], CORNERS) - share).abs() < 1e-12);
        }
    }

    /// A cube whose axes are no axes of f64, with its faces outward.
    fn turned_cube(size: f64) -> Vec<[[f64; 3]; 3]> {
        let [x, y] = [DVec3::new(0.36, 0.48, -0.8), DVec3::new(-0.8, 0.6, 0.0)];
        let corner = |i: usize| {
            let side = |bit: usize| if i & bit == 0 { -size } else { size };
            (side(1) * x + side(2) * y + side(4) * x.cross(y)).to_array()
        };
        let faces =
            [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let halves = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
        halves.map(|half| half.map(corner)).collect()
    }

    #[test]
    fn the_sides_of_a_cube_cover_all_or_nothing_beside_edges_too() {
        for size in [1e-300, 1e-30, 1.0, 1e200] {
            let cube = turned_cube(size);
            for (edge, number) in
                cube.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).zip(1..)
            {
                let share = f64::from(number) / 37.0;
                let middle = DVec3::from(edge[0]).lerp(edge[1].into(), share).to_array();
                for steps in 0..64 {
                    // From none to three units in the last place aside on each axis.
                    let point = [0, 1, 2]
                        .map(|k| (0..steps >> (2 * k) & 3).fold(middle[k], |x, _| x.next_up()));
                    let sum: f64 = cube.iter().map(|&side| solid_angle(point, side)).sum();
                    let off = (sum - sum.round()).abs();
                    let is_on = cube.iter().any(|&side| crate::exact::is_on_triangle(point, side));
                    assert!(is_on || off < 1e-5, "{size:e}, {edge:?} at {share}, {steps}: {sum}");
                }
            }
        }
    }

    #[test]
    fn size_does_not_matter() {
        for scale in [1e-310, 1e-200, 1e-90, 1e90, 1e200, 1e308] {
            let corners = CORNERS.map(|p| p.map(|x| x * scale));
            let share = solid_angle([0.25 * scale; 3], corners);
            assert!(
                (share / solid_angle([0.25; 3], CORNERS) - 1.0).abs() < 1e-12,
                "{scale}: {share}"
            );
        }
    }

    #[test]
    fn what_has_no_area_covers_nothing() {
        let line = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
        for point in [[0.0; 3], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]] {
            assert_eq!(solid_angle(point, line), 0.0, "{point:?}");
        }
        assert_eq!(solid_angle([3.0, 1.0, 0.0], [[1.0, 2.0, 3.0]; 3]), 0.0);
    }
}
