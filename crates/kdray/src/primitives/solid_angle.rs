//! How large a triangle looks from a point.

use super::range::in_range;
use crate::exact::side_of_plane;
use glam::DVec3;
use std::cmp::Ordering;
use std::f64::consts::PI;

/// Products of three shorter lengths may underflow.
const LEAST: f64 = 1e-100;

/// The solid angle that a triangle covers seen from `point`, as a share of the whole sphere:
/// positive from behind, negative from the front, zero in the triangle's plane.
///
/// Van Oosterom and Strackee's formula (1983). Where a quarter of the sphere or more is covered, near a
/// triangle, the share leaps from a half to minus a half at the plane: there its sign is exact, and it is zero in
/// the plane exactly, for the side that the point is on is decided without rounding. Farther away it goes
/// through zero without a leap, and in the plane may be off by rounding, either way.
pub fn solid_angle(point: [f64; 3], corners: [[f64; 3]; 3]) -> f64 {
    let ([p, a, b, c], _) = in_range([point, corners[0], corners[1], corners[2]]);
    let mut ways = [a - p, b - p, c - p];
    if ways.iter().any(|way| way.length_squared() < LEAST * LEAST) {
        // How far away corners are does not matter.
        ways = ways.map(unit);
    }
    let [a, b, c] = ways;
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let volume = a.dot(b.cross(c));
    let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    // Half the angle, over pi; a quarter of the sphere is covered where `below` is zero.
    let share = volume.atan2(below) / (2.0 * PI);
    if below > 0.0 {
        return share;
    }
    match side_of_plane(point, corners) {
        Ordering::Equal => 0.0,
        Ordering::Less => share.abs(),
        Ordering::Greater => -share.abs(),
    }
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
