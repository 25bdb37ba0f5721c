//! On which side of a plane a point lies.

use super::edge::volume_sign;
use std::cmp::Ordering;

/// A bound for the error of the volume below, in units of the sum of its terms' absolute values:
/// 8 roundings at most (Shewchuk 1997, §4.3, the first bound of his ORIENT3D), and room to spare.
const ERROR: f64 = 8.0 * f64::EPSILON;

/// How `point` lies to the plane through the corners a, b, c: `Greater` in front of it, where
/// (b−a) x (c−a) points to, `Less` behind, `Equal` in the plane; also if the corners lie on a line.
///
/// In f64 with an error bound, and without rounding where that cannot tell.
pub fn side_of_plane(point: [f64; 3], corners: [[f64; 3]; 3]) -> Ordering {
    let [a, b, c] = corners.map(|p| [p[0] - point[0], p[1] - point[1], p[2] - point[2]]);
    let (mut sum, mut terms, mut largest) = (0.0, 0.0, 0.0_f64);
    for (i, height) in a.into_iter().enumerate() {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let (forward, backward) = (b[j] * c[k], b[k] * c[j]);
        sum -= height * (forward - backward);
        terms += height.abs() * (forward.abs() + backward.abs());
        largest = largest.max(height.abs());
    }
    // What underflows is lost whole, and an inner product's loss is multiplied.
    let error = ERROR * terms + f64::MIN_POSITIVE * (1.0 + largest);
    // False where something has overflowed.
    if sum.abs() > error && error < f64::INFINITY {
        return sum.total_cmp(&0.0);
    }
    volume_sign(point, corners)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::volume;
    use proptest::prelude::*;

    const CORNERS: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    #[test]
    fn the_front_is_where_the_normal_points_to() {
        assert_eq!(side_of_plane([1.0; 3], CORNERS), Ordering::Greater);
        assert_eq!(side_of_plane([0.0; 3], CORNERS), Ordering::Less);
        assert_eq!(side_of_plane([0.25, 0.25, 0.5], CORNERS), Ordering::Equal);
        assert_eq!(side_of_plane([0.25, 0.25, 0.5_f64.next_up()], CORNERS), Ordering::Greater);
        assert_eq!(side_of_plane([0.25, 0.25, 0.5_f64.next_down()], CORNERS), Ordering::Less);
    }

    #[test]
    fn no_size_is_out_of_range() {
        for scale in [1e-300, 1e-120, 1e120, 1e300] {
            let corners = CORNERS.map(|p| p.map(|x| x * scale));
            for (factor, side) in [(0.5, Ordering::Greater), (0.25, Ordering::Less)] {
                assert_eq!(side_of_plane([scale * factor; 3], corners), side, "{scale}");
            }
        }
    }

    proptest! {
        #[test]
        fn the_filter_agrees_with_the_long_sum(
            corners in prop::array::uniform3(prop::array::uniform3(-4_i8..4)),
            weights in prop::array::uniform3(-2_i8..3),
            steps in prop::array::uniform3(-1_i8..2),
        ) {
            // Points in the plane or a step away from it, off the origin so that terms cancel.
            let corners = corners.map(|p| p.map(|x| 0.1 + f64::from(x)));
            let mix = |k: usize| (0..3).map(|i| f64::from(weights[i]) * corners[i][k]).sum::<f64>();
            let step = |k: usize, x: f64| match steps[k] {
                -1 => x.next_down(),
                0 => x,
                _ => x.next_up(),
            };
            let point = std::array::from_fn(|k| step(k, mix(k)));
            prop_assert_eq!(side_of_plane(point, corners), volume(point, corners).sign());
        }
    }
}
