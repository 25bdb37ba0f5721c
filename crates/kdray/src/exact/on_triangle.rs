//! Whether a point lies on a triangle.

use super::edge::cross_sign;
use super::side_of_plane;
use std::cmp::Ordering;

/// Whether `point` belongs to the closed triangle: lies in its interior, on an edge or in a corner.
/// A triangle without area is the segment, or the point, that its corners span.
///
/// A point of the plane belongs to the triangle if its shadow on each coordinate plane belongs to
/// the triangle's. For at least one of the planes tells all points of the triangle's plane apart,
/// and where none does, the three shadows of a segment leave no other point.
pub fn is_on_triangle(point: [f64; 3], corners: [[f64; 3]; 3]) -> bool {
    is_in_box(point, corners)
        && side_of_plane(point, corners) == Ordering::Equal
        && (0..3).all(|axis| is_in_shadow(point, corners, ((axis + 1) % 3, (axis + 2) % 3)))
}

fn is_in_box(point: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> bool {
    (0..3).all(|k| {
        let (low, high) = (a[k].min(b[k]).min(c[k]), a[k].max(b[k]).max(c[k]));
        low <= point[k] && point[k] <= high
    })
}

/// Whether a point of the triangle's box lies in the triangle, both seen along an axis.
///
/// It does if no two edges have it on opposite sides. That is so too if all of it lies on a line
/// with the point: then the box decides.
fn is_in_shadow(point: [f64; 3], [a, b, c]: [[f64; 3]; 3], plane: (usize, usize)) -> bool {
    let sides = [(a, b), (b, c), (c, a)];
    let signs = sides.map(|(p, q)| cross_sign(point, p, q, plane));
    !(signs.contains(&Ordering::Less) && signs.contains(&Ordering::Greater))
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    #[test]
    fn a_triangle_is_closed() {
        let inside = [[0.25, 0.25, 0.5], [0.5, 0.5, 0.0], [1.0, 0.0, 0.0], [-0.0, 0.0, 1.0]];
        for point in inside {
            assert!(is_on_triangle(point, CORNERS), "{point:?}");
        }
    }

    #[test]
    fn a_step_in_any_direction_leaves_an_inner_point_of_a_slanted_plane() {
        for axis in 0..3 {
            for step in [f64::next_up, f64::next_down] {
                let mut point = [0.25, 0.25, 0.5];
                point[axis] = step(point[axis]);
                assert!(!is_on_triangle(point, CORNERS), "{point:?}");
            }
        }
    }

    #[test]
    fn points_of_the_plane_beside_the_triangle_are_off() {
        for point in [[-1.0, 1.0, 1.0], [0.75, 0.5, -0.25], [1.0, 1.0, -1.0], [2.0, -1.0, 0.0]] {
            assert_eq!(side_of_plane(point, CORNERS), Ordering::Equal);
            assert!(!is_on_triangle(point, CORNERS), "{point:?}");
        }
    }

    #[test]
    fn triangles_in_coordinate_planes_have_edges_too() {
        let flat = [[0.0, 0.0, 7.0], [4.0, 0.0, 7.0], [0.0, 4.0, 7.0]];
        for point in [[1.0, 1.0, 7.0], [2.0, 2.0, 7.0], [0.0, 3.0, 7.0]] {
            assert!(is_on_triangle(point, flat));
        }
        let outside = 2.0_f64.next_up();
        for point in [[2.0, outside, 7.0], [3.0, 3.0, 7.0], [1.0, 1.0, 7.0_f64.next_up()]] {
            assert!(!is_on_triangle(point, flat), "{point:?}");
        }
    }

    #[test]
    fn without_area_it_is_a_segment_or_a_point() {
        let line = [[0.0; 3], [3.0, 6.0, 9.0], [1.0, 2.0, 3.0]];
        assert!(is_on_triangle([2.0, 4.0, 6.0], line));
        assert!(!is_on_triangle([2.0, 4.0, 6.0_f64.next_up()], line));
        assert!(!is_on_triangle([2.0, 3.0, 6.0], line));
        assert!(!is_on_triangle([4.0, 8.0, 12.0], line));
        let point = [[1.0, 2.0, 3.0]; 3];
        assert!(is_on_triangle([1.0, 2.0, 3.0], point));
        assert!(!is_on_triangle([1.0, 2.0, 3.0_f64.next_up()], point));
    }
}
