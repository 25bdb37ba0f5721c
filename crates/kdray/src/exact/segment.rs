//! Whether a triangle lies between two points.

use super::side_of_plane;
use std::cmp::Ordering;

/// Whether the open segment from `from` to `to` crosses the closed triangle: the ends lie on
/// opposite sides of its plane, and the line between them meets it, be it at an edge or a corner.
///
/// An end in the plane does not count, nor does a segment that runs in it. No number is rounded,
/// not even the difference of the ends.
pub fn segment_crosses(from: [f64; 3], to: [f64; 3], corners: [[f64; 3]; 3]) -> bool {
    let side = side_of_plane(from, corners);
    if side == Ordering::Equal || side_of_plane(to, corners) != side.reverse() {
        return false;
    }
    let [a, b, c] = corners;
    let mut signs = [(a, b), (b, c), (c, a)].map(|(p, q)| side_of_plane(from, [to, p, q]));
    signs.sort_unstable();
    // The line is not in the plane, so it misses a corner at least.
    !(signs[0] == Ordering::Less && signs[2] == Ordering::Greater)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [[f64; 3]; 3] = [[0.0, 0.0, 5.0], [4.0, 0.0, 5.0], [0.0, 4.0, 5.0]];

    #[test]
    fn edges_and_corners_belong_to_the_triangle() {
        for (x, y) in [(1.0, 1.0), (0.0, 0.0), (4.0, 0.0), (2.0, 2.0), (0.0, 1.0)] {
            assert!(segment_crosses([x, y, 0.0], [x, y, 9.0], CORNERS), "{x} {y}");
            assert!(segment_crosses([x, y, 9.0], [x, y, 0.0], CORNERS), "{x} {y}");
        }
        let beside = -f64::from_bits(1);
        for (x, y) in [(beside, 1.0), (1.0, beside), (2.0, 2.0_f64.next_up())] {
            assert!(!segment_crosses([x, y, 0.0], [x, y, 9.0], CORNERS), "{x} {y}");
        }
    }

    #[test]
    fn ends_do_not_count_and_a_step_behind_them_does() {
        let (above, below) = (5.0_f64.next_up(), 5.0_f64.next_down());
        for z in [5.0, below, 0.0] {
            assert!(!segment_crosses([1.0, 1.0, z], [1.0, 1.0, -3.0], CORNERS), "{z}");
            assert!(!segment_crosses([1.0, 1.0, -3.0], [1.0, 1.0, z], CORNERS), "{z}");
        }
        assert!(segment_crosses([1.0, 1.0, above], [1.0, 1.0, below], CORNERS));
    }

    #[test]
    fn a_segment_in_the_plane_crosses_nothing() {
        assert!(!segment_crosses([-1.0, 1.0, 5.0], [5.0, 1.0, 5.0], CORNERS));
        let line = [[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [2.0, 0.0, 5.0]];
        assert!(!segment_crosses([1.0, 0.0, 0.0], [1.0, 0.0, 9.0], line));
    }
}
