//! Points whose differences can be multiplied.

use crate::geometry::inverse_power_of_two;
use glam::DVec3;
use std::ops::Range;

/// How large differences may be so that products of four neither over- nor underflow.
const SIZES: Range<f64> = power_of_two(-200)..power_of_two(250);

/// The same points, times a power of two by which their differences are far from over- and underflow, and that
/// power. It is one for all sizes that f32 has, and more.
///
/// What underflows in points that are made smaller is nothing beside their differences.
#[inline]
pub(crate) fn in_range<const N: usize>(points: [[f64; 3]; N]) -> ([DVec3; N], f64) {
    let points = points.map(DVec3::from);
    let size = size(&points);
    if SIZES.contains(&size) { (points, 1.0) } else { scaled(points, size) }
}

#[cold]
fn scaled<const N: usize>(points: [DVec3; N], size: f64) -> ([DVec3; N], f64) {
    // Differences of the largest numbers overflow.
    let scale = if size.is_finite() {
        inverse_power_of_two(size)
    } else {
        0.25 * inverse_power_of_two(self::size(&points.map(|p| 0.25 * p)))
    };
    (points.map(|p| p * scale), scale)
}

/// The largest difference to the first of them on any axis.
#[inline]
fn size(points: &[DVec3]) -> f64 {
    let ways = points[1..].iter().map(|&p| (p - points[0]).abs());
    ways.fold(DVec3::ZERO, DVec3::max).max_element()
}

const fn power_of_two(exponent: i64) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_far_from_both_ends_stays() {
        for size in [1e-45, 1e-3, 1.0, 1e38, 1e70] {
            let points = [[size, 0.0, 0.0], [0.0, -size, 3.0]];
            assert_eq!(in_range(points), (points.map(DVec3::from), 1.0));
        }
    }

    #[test]
    fn differences_become_one_to_eight() {
        for size in [1e-300, 1e-70, 1e80, 1e300, f64::MAX] {
            let ([p, q], scale) = in_range([[size, 1.0, 0.0], [-size, 1.0, 0.0]]);
            assert!((1.0..=8.0).contains(&(p - q).x), "{size}: {p} {q}");
            assert_eq!(p.x / scale, size);
        }
        let ([p, q], _) = in_range([[5e-324, 0.0, 0.0], [0.0; 3]]);
        assert!(SIZES.contains(&(p - q).x));
        assert_eq!(in_range([[1e300; 3]; 2]).1, 1.0);
    }
}
