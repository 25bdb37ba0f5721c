//! The axis-aligned bounding box and the slab test (S3, S4 of the founding lecture).

use super::{Interval, Ray, t_above, t_below, widened};

/// An axis-aligned bounding box in K dimensions: the points P with `min ≤ P ≤ max` on every axis.
///
/// The box is closed: its faces belong to it. A box with `min > max` on some axis is empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb<const K: usize = 3> {
    /// The smallest coordinate on each axis.
    pub min: [f32; K],
    /// The largest coordinate on each axis.
    pub max: [f32; K],
}

impl<const K: usize> Aabb<K> {
    /// The box that holds nothing, from which [`union`](Self::union) grows.
    pub const EMPTY: Self = Self { min: [f32::INFINITY; K], max: [f32::NEG_INFINITY; K] };

    /// The smallest box that holds all `points`.
    pub fn of_points(points: impl IntoIterator<Item = [f32; K]>) -> Self {
        points.into_iter().fold(Self::EMPTY, |aabb, p| aabb.union(&Self { min: p, max: p }))
    }

    /// Whether the box holds no point.
    pub fn is_empty(&self) -> bool {
        (0..K).any(|axis| self.min[axis] > self.max[axis])
    }

    /// The smallest box that holds both.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self {
            min: std::array::from_fn(|axis| self.min[axis].min(other.min[axis])),
            max: std::array::from_fn(|axis| self.max[axis].max(other.max[axis])),
        }
    }

    /// The box that both share; empty if they do not meet.
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Self {
        Self {
            min: std::array::from_fn(|axis| self.min[axis].max(other.min[axis])),
            max: std::array::from_fn(|axis| self.max[axis].min(other.max[axis])),
        }
    }

    /// The two boxes into which the plane at `split` perpendicular to `axis` cuts this one: below
    /// (the lecture's L) and above (R). `split` must lie within the box.
    pub fn split(&self, axis: usize, split: f32) -> (Self, Self) {
        let (mut below, mut above) = (*self, *self);
        below.max[axis] = split;
        above.min[axis] = split;
        (below, above)
    }

    /// The side lengths, in f64 so that they neither overflow nor round.
    pub fn extent(&self) -> [f64; K] {
        std::array::from_fn(|axis| f64::from(self.max[axis]) - f64::from(self.min[axis]))
    }

    /// The axis of the longest side; the first of equals.
    pub fn longest_axis(&self) -> usize {
        let extent = self.extent();
        (1..K).fold(0, |best, axis| if extent[axis] > extent[best] { axis } else { best })
    }

    /// All axes, those of longer sides first; of equals in their order.
    pub(crate) fn axes_by_length(&self) -> [usize; K] {
        let extent = self.extent();
        let mut axes = std::array::from_fn(|axis| axis);
        axes.sort_by(|&a: &usize, &b: &usize| extent[b].total_cmp(&extent[a]));
        axes
    }

    /// The length of the diagonal.
    pub fn diagonal(&self) -> f64 {
        self.extent().iter().map(|e| e * e).sum::<f64>().sqrt()
    }

    /// The middle of the box.
    pub fn center(&self) -> [f64; K] {
        std::array::from_fn(|axis| 0.5 * (f64::from(self.min[axis]) + f64::from(self.max[axis])))
    }

    /// Whether the point `p` belongs to the box.
    pub fn contains(&self, p: [f64; K]) -> bool {
        (0..K).all(|axis| {
            f64::from(self.min[axis]) <= p[axis] && p[axis] <= f64::from(self.max[axis])
        })
    }

    /// Half the measure of the box's surface: in 3-D half the surface area, in 2-D half the
    /// perimeter. The chance that a random line which meets a convex box also meets a convex box
    /// inside it is the ratio of their surfaces, which is what the surface area heuristic rests on.
    pub fn half_surface(&self) -> f64 {
        let extent = self.extent();
        let face = |skip: usize| -> f64 {
            (0..K).filter(|&axis| axis != skip).map(|axis| extent[axis]).product()
        };
        (0..K).map(face).sum()
    }

    /// The slab test: the interval of t for which the line of `ray`, cut to the ray's own
    /// interval, lies in the closed box, or `None`.
    ///
    /// Per axis the line meets the two planes at l and h; with m = min(l, h) and M = max(l, h),
    /// t_min is the largest m and t_max the smallest M. The ray hits if t_min ≤ t_max: unlike in
    /// the lecture's t_min < t_max, touching an edge or a corner counts.
    ///
    /// A ray parallel to a slab (a component of zero or negative zero) is inside it for all t or
    /// for none; one that runs in a face is inside. The interval, the ray's own included, is widened
    /// by 2^-38 of t, so that no rounding excludes a t for which the exact point lies in the box. A
    /// ray that starts in the box is inside from exactly zero.
    ///
    /// The lecture's worked example, a box from (−2, −2, 4) to (2, 2, 9):
    /// ```
    /// use kdray::{Aabb, Ray};
    /// let triangle = [[-2.0, 2.0, 4.0], [2.0, 2.0, 4.0], [2.0, -2.0, 9.0]];
    /// let aabb = Aabb::of_points(triangle);
    /// let ray = Ray::through([0.0, 0.0, 0.0], [0.4, 0.1, 1.0]);
    /// let interval = aabb.slab(&ray).expect("t_min = 4 < t_max = 5: hit");
    /// assert!((interval.t_min - 4.0).abs() < 1e-9 && (interval.t_max - 5.0).abs() < 1e-9);
    /// ```
    pub fn slab(&self, ray: &Ray<K>) -> Option<Interval> {
        let mut inside = widened(ray.interval);
        for axis in 0..K {
            let (e, d) = (ray.origin[axis], ray.direction[axis]);
            let (min, max) = (f64::from(self.min[axis]), f64::from(self.max[axis]));
            if d == 0.0 {
                if e < min || e > max {
                    return None;
                }
                continue;
            }
            let (l, h) = ((min - e) / d, (max - e) / d);
            inside.t_min = inside.t_min.max(t_below(l.min(h)));
            inside.t_max = inside.t_max.min(t_above(l.max(h)));
        }
        (!self.is_empty() && !inside.is_empty()).then_some(inside)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: Aabb<3> = Aabb { min: [0.0; 3], max: [1.0; 3] };

    fn assert_interval(ray: Ray, expected: Option<(f64, f64)>) {
        match (UNIT.slab(&ray), expected) {
            (None, None) => {}
            (Some(found), Some((t_min, t_max))) => {
                assert!((found.t_min - t_min).abs() < 1e-9, "{ray:?}: {found:?}");
                assert!((found.t_max - t_max).abs() < 1e-9, "{ray:?}: {found:?}");
            }
            (found, _) => panic!("{ray:?}: {found:?}, expected {expected:?}"),
        }
    }

    #[test]
    fn the_lecture_example_hits_from_four_to_five() {
        let aabb = Aabb { min: [-2.0, -2.0, 4.0], max: [2.0, 2.0, 9.0] };
        let ray = Ray::through([0.0, 0.0, 0.0], [0.4, 0.1, 1.0]);
        let found = aabb.slab(&ray).unwrap();
        assert!((found.t_min - 4.0).abs() < 1e-9 && (found.t_max - 5.0).abs() < 1e-9);
    }

    #[test]
    fn zero_and_negative_zero_components_are_parallel_to_the_slab() {
        for zero in [0.0, -0.0] {
            assert_interval(Ray::new([0.5, 0.5, -1.0], [zero, zero, 1.0]), Some((1.0, 2.0)));
            assert_interval(Ray::new([1.5, 0.5, -1.0], [zero, zero, 1.0]), None);
        }
    }

    #[test]
    fn rays_in_faces_edges_and_corners_are_inside() {
        for zero in [0.0, -0.0] {
            assert_interval(Ray::new([0.0, 0.5, -1.0], [zero, zero, 1.0]), Some((1.0, 2.0)));
            assert_interval(Ray::new([1.0, 1.0, -1.0], [zero, zero, 1.0]), Some((1.0, 2.0)));
        }
        assert_interval(Ray::new([-1.0, 0.0, 1.0], [1.0, 0.0, 0.0]), Some((1.0, 2.0)));
        assert_interval(Ray::new([-1.0, 2.0, 0.0], [1.0, -1.0, 0.0]), Some((1.0, 2.0)));
    }

    #[test]
    fn a_ray_from_inside_starts_at_its_own_t_min() {
        assert_interval(Ray::new([0.5; 3], [0.0, 0.0, 2.0]), Some((0.0, 0.25)));
        let backward = Ray::new([0.5; 3], [0.0, 0.0, 2.0]).with_interval(-1.0, 1.0);
        assert_interval(backward, Some((-0.25, 0.25)));
    }

    #[test]
    fn behind_and_beside_are_misses() {
        assert_interval(Ray::new([0.5, 0.5, 2.0], [0.0, 0.0, 1.0]), None);
        assert_interval(Ray::new([0.5, 0.5, -1.0], [0.0, 2.0, 1.0]), None);
        assert!(Aabb::EMPTY.slab(&Ray::new([0.0; 3], [1.0, 1.0, 1.0])).is_none());
    }

    #[test]
    fn half_surface_is_area_in_3d_and_perimeter_in_2d() {
        let aabb = Aabb { min: [0.0, 0.0, 0.0], max: [1.0, 2.0, 3.0] };
        assert_eq!(aabb.half_surface(), 11.0);
        assert_eq!(Aabb { min: [0.0, 0.0], max: [3.0, 4.0] }.half_surface(), 7.0);
    }
}
