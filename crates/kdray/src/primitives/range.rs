//! Points whose differences can be multiplied.

use crate::geometry::inverse_power_of_two;
use glam::DVec3;
use std::ops::Range;

/// How large differences may be so that products of four neither over- nor underflow.
const SIZES: Range<f64> = power_of_two(-200)..power_of_two(250);

/// By what points were multiplied: a power of two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scale {
    factor: f64,
    /// What was taken away from all the points first: on an axis where the products would overflow, the
    /// coordinate that is the same in all of them; elsewhere zero.
    common: DVec3,
}

impl Scale {
    const ONE: Self = Self { factor: 1.0, common: DVec3::ZERO };

    /// What a length among the points was before.
    #[inline]
    pub(crate) fn length_back(self, length: f64) -> f64 {
        length / self.factor
    }

    /// Where a point was before.
    #[inline]
    pub(crate) fn point_back(self, point: DVec3) -> DVec3 {
        // To add zero would lose the sign of -0.
        DVec3::select(self.common.cmpeq(DVec3::ZERO), point / self.factor, self.common)
    }
}

/// The same points, times a power of two by which their differences are far from over- and underflow, and that
/// power. It is one for all sizes that f32 has, and more.
///
/// What underflows in points that are made smaller is nothing beside their differences. What would overflow in
/// points that are made larger is a coordinate that all of them share, for others differ by a unit in the last
/// place, which is more than the largest difference. It becomes zero, so that differences stay.
#[inline]
pub(crate) fn in_range<const N: usize>(points: [[f64; 3]; N]) -> ([DVec3; N], Scale) {
    let points = points.map(DVec3::from);
    let size = size(&points);
    if SIZES.contains(&size) { (points, Scale::ONE) } else { scaled(points, size) }
}

#[cold]
fn scaled<const N: usize>(points: [DVec3; N], size: f64) -> ([DVec3; N], Scale) {
    // Differences of the largest numbers overflow.
    let factor = if size.is_finite() {
        inverse_power_of_two(size)
    } else {
        0.25 * inverse_power_of_two(self::size(&points.map(|p| 0.25 * p)))
    };
    let fits = (points[0] * factor).is_finite_mask();
    let common = DVec3::select(fits, DVec3::ZERO, points[0]);
    (points.map(|p| (p - common) * factor), Scale { factor, common })
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
            assert_eq!(in_range(points), (points.map(DVec3::from), Scale::ONE));
        }
    }

    #[test]
    fn differences_become_one_to_eight() {
        for size in [1e-300, 1e-70, 1e80, 1e300, f64::MAX] {
            let ([p, q], scale) = in_range([[size, 1.0, 0.0], [-size, 1.0, 0.0]]);
            assert!((1.0..=8.0).contains(&(p - q).x), "{size}: {p} {q}");
            assert_eq!(scale.point_back(p).x, size);
        }
        let ([p, q], _) = in_range([[5e-324, 0.0, 0.0], [0.0; 3]]);
        assert!(SIZES.contains(&(p - q).x));
        assert_eq!(in_range([[1e300; 3]; 2]).1, Scale::ONE);
    }

    #[test]
    fn a_coordinate_that_all_share_does_not_overflow() {
        for shared in [1e300, -1e300, f64::MAX] {
            for size in [5e-324, 1e-100, 1e-10] {
                let given = [[shared, size, 0.0], [shared, 0.0, -0.0], [shared, -size, 1.0]];
                let (points, scale) = in_range(given.map(|[x, y, z]| [x, y, z * size]));
                assert!(points.iter().all(|p| p.is_finite()), "{shared}, {size}: {points:?}");
                assert!((points[0] - points[2]).y > 0.0);
                assert_eq!(scale.point_back(points[0]), DVec3::new(shared, size, 0.0));
                assert_eq!(scale.point_back(points[1]).z.to_bits(), (-0.0_f64).to_bits());
            }
        }
    }
}
