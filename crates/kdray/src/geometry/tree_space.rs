//! The coordinates that the trees over f64 meshes are in.

use super::{Aabb, Coordinate, Ray, inverse_power_of_two};

/// The coordinates of a tree: a point of the mesh less a centre, times a power of two.
///
/// Trees are f32. Those over f32 meshes are in the mesh's own coordinates. Vertices in f64 are first
/// moved, so that the middle of the mesh is at zero, and scaled, so that its farthest coordinate is
/// from 1 to 2; boxes are then rounded outward. A ray is moved and scaled alike, in f64, and its t stays
/// the same.
///
/// # What rounding does
/// With u = 2^-53, a vertex is moved by less than 2 u: once for the difference, for the scale is exact.
/// A ray's origin is moved by u times its distance from the centre on an axis. Up to a distance of 4
/// that is 4 u; from farther it is less than 2 u of the way to anything in the tree, and so a relative
/// error of t, for which the walk has slack (see `slack.rs`). So a point at which a ray meets a triangle
/// lies within 2^-47, which is 64 u, of the triangle as the tree sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TreeSpace {
    center: [f64; 3],
    scale: f64,
}

impl Default for TreeSpace {
    fn default() -> Self {
        Self::OF_MESH
    }
}

impl TreeSpace {
    /// The mesh's own coordinates.
    pub const OF_MESH: Self = Self { center: [0.0; 3], scale: 1.0 };

    /// How far apart a point of a ray and a triangle may be in the tree that meet in the mesh; and by how
    /// much boxes are wider at least.
    pub(crate) const ERROR: f64 = 1.0 / (1_u64 << 47) as f64;

    /// What the tree's coordinates are less than, in size.
    pub(crate) const FARTHEST: f32 = 2.0;

    /// The space for a mesh whose points lie between `min` and `max`; the mesh's own for coordinates that
    /// fit, and if there are no points.
    pub(crate) fn around<T: Coordinate>(min: [f64; 3], max: [f64; 3]) -> Self {
        if T::FITS_TREE || min[0] > max[0] {
            return Self::OF_MESH;
        }
        // Halved first, so that nothing overflows.
        let center: [f64; 3] = std::array::from_fn(|k| 0.5 * min[k] + 0.5 * max[k]);
        let size = |k: usize| (max[k] - center[k]).max(center[k] - min[k]);
        let farthest = size(0).max(size(1)).max(size(2));
        Self { center, scale: inverse_power_of_two(farthest) }
    }

    /// The point of the mesh that is at zero.
    pub fn center(&self) -> [f64; 3] {
        self.center
    }

    /// The power of two by which the tree is larger than the mesh.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// A point of the mesh as the tree sees it.
    #[inline(always)]
    pub fn point(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let ([a, b, c], scale) = (self.center, self.scale);
        [(x - a) * scale, (y - b) * scale, (z - c) * scale]
    }

    /// What is in a box of the tree, in the mesh's coordinates: its least and its greatest corner, but for
    /// rounding.
    pub(crate) fn corners_in_mesh(&self, bounds: &Aabb<3>) -> [[f64; 3]; 2] {
        let place = |corner: [f32; 3]| {
            std::array::from_fn(|k| {
                let way = f64::from(corner[k]) / self.scale;
                way.clamp(f64::MIN, f64::MAX) + self.center[k]
            })
        };
        [place(bounds.min), place(bounds.max)]
    }

    /// How far a point may be, in the tree, from where it would be without rounding: a relative 2^-53 on each
    /// axis.
    #[inline]
    pub(crate) fn point_error([x, y, z]: [f64; 3]) -> f64 {
        f64::EPSILON * (x.abs() + y.abs() + z.abs())
    }

    /// A ray as the tree sees it: t is the same. `None` if its numbers would over- or underflow.
    ///
    /// What underflow takes of a component is less than 2^-1074: along the ray, whose largest is above
    /// 2^-1000, that is nothing within the tree.
    pub(crate) fn ray(&self, ray: &Ray<3>) -> Option<Ray<3>> {
        const LEAST: f64 = 1e-300;
        let origin = self.point(ray.origin);
        let direction = ray.direction.map(|d| d * self.scale);
        let fits = origin.iter().chain(&direction).all(|x| x.is_finite())
            && direction.iter().any(|d| d.abs() > LEAST);
        fits.then_some(Ray { origin, direction, interval: ray.interval })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_middle_is_at_zero_and_the_farthest_at_one_to_two() {
        for size in [5e-324, 1e-310, 1e-300, 1e-30, 0.75, 1.0, 3.0, 1e30, 1e300, f64::MAX] {
            for middle in [0.0, 1.0, -6e5] {
                let (min, max) = (middle - size, middle + size);
                if !(min < max && min.is_finite() && max.is_finite()) {
                    continue;
                }
                let space = TreeSpace::around::<f64>([min; 3], [max; 3]);
                let (low, high) = (space.point([min; 3])[0], space.point([max; 3])[0]);
                assert!(-2.0 < low && low <= 0.0 && (0.0..2.0).contains(&high), "{size} {middle}");
                let is_large = max - min > 1e-300 && (low <= -1.0 || high >= 1.0);
                assert!(is_large || max - min < 1e-300, "{size} {middle}: {low} {high}");
            }
        }
    }

    #[test]
    fn meshes_without_extent_are_only_moved() {
        let point = [3.0, 1e300, -5e-300];
        let space = TreeSpace::around::<f64>(point, point);
        assert_eq!((space.point(point), space.scale()), ([0.0; 3], 1.0));
        let nothing = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        assert_eq!(TreeSpace::around::<f64>(nothing.0, nothing.1), TreeSpace::OF_MESH);
        assert_eq!(TreeSpace::around::<f32>([1.0; 3], [9.0; 3]), TreeSpace::OF_MESH);
    }

    #[test]
    fn rays_whose_numbers_do_not_fit_are_told() {
        let huge = TreeSpace::around::<f64>([-1e300; 3], [1e300; 3]);
        let tiny = TreeSpace::around::<f64>([-1e-300; 3], [1e-300; 3]);
        let ray = |o: f64, d: f64| Ray::new([o, 0.0, 0.0], [0.0, d, 0.0]);
        assert!(huge.ray(&ray(1e308, 1e5)).is_some() && huge.ray(&ray(0.0, 1e-5)).is_none());
        assert!(tiny.ray(&ray(1e-290, 1e-5)).is_some());
        assert!(tiny.ray(&ray(1e10, 1.0)).is_none() && tiny.ray(&ray(0.0, 1e10)).is_none());
        assert!(tiny.ray(&ray(f64::NAN, 1.0)).is_none());
    }

    proptest! {
        /// In units that make all of it integers below 2^53, rounding is seen.
        #[test]
        fn points_are_moved_by_less_than_the_error(
            min in -1e9..1e9_f64, extent in 1e-6..1e9_f64, share in 0.0..1.0_f64
        ) {
            let max = min + extent;
            let space = TreeSpace::around::<f64>([min; 3], [max; 3]);
            let x = (min + share * extent).clamp(min, max);
            let [found, ..] = space.point([x; 3]);
            // The difference of two numbers and what it lost (Knuth's TwoSum).
            let c = -space.center()[0];
            let sum = x + c;
            let back = sum - x;
            let lost = (x - (sum - back)) + (c - back);
            prop_assert_eq!(found, sum * space.scale());
            prop_assert!((lost * space.scale()).abs() <= TreeSpace::ERROR / 32.0);
        }
    }
}
