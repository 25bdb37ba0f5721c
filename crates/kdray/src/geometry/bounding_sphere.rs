//! The sphere as a bounding volume.

use super::{Aabb, BoundingVolume, Interval, Ray, chord, t_above, t_below, widened};

/// A ball in K dimensions that holds an object (S1): cheap to test, loose for long objects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingSphere<const K: usize = 3> {
    /// The middle.
    pub center: [f64; K],
    /// The radius; nothing lies in a sphere of negative radius.
    pub radius: f64,
}

impl<const K: usize> BoundingSphere<K> {
    /// A sphere around all `points`: the middle of their box, and the farthest of them, a little
    /// rounded up. Not the smallest one, which costs more to find than it saves.
    pub fn of_points(points: impl IntoIterator<Item = [f32; K]> + Clone) -> Self {
        let aabb = Aabb::of_points(points.clone());
        if aabb.is_empty() {
            return Self { center: [0.0; K], radius: -1.0 };
        }
        let center = aabb.center();
        let squared = |p: [f32; K]| -> f64 {
            p.iter().zip(&center).map(|(&p, c)| (f64::from(p) - c) * (f64::from(p) - c)).sum()
        };
        let farthest = points.into_iter().map(squared).fold(0.0, f64::max);
        Self { center, radius: farthest.sqrt() * (1.0 + 1e-12) }
    }

    /// The sphere around a box, and so around all that lies in it.
    pub fn of_aabb(aabb: &Aabb<K>) -> Self {
        let radius = if aabb.is_empty() { -1.0 } else { 0.5 * aabb.diagonal() * (1.0 + 1e-12) };
        Self { center: aabb.center(), radius }
    }
}

impl<const K: usize> BoundingVolume<K> for BoundingSphere<K> {
    /// As [`Aabb::slab`], the interval is widened by 2^-38 of t.
    fn ray_interval(&self, ray: &Ray<K>) -> Option<Interval> {
        // A wider sphere makes good what rounding does to the point nearest to the centre, by far
        // less than 16 steps of the largest coordinate: both sides of the chord grow by as much.
        let distances = (0..K).map(|k| (self.center[k] - ray.origin[k]).abs());
        let scale = distances.chain(self.center.map(f64::abs)).fold(self.radius, f64::max);
        let radius = self.radius + 16.0 * f64::EPSILON * scale + f64::MIN_POSITIVE;
        if self.radius < 0.0 {
            return None;
        }
        let [enter, leave] = chord(ray, &self.center, radius)?.t;
        // NaN bounds nothing: the larger and the smaller of it and a number are the number.
        let chord = Interval { t_min: t_below(enter), t_max: t_above(leave) };
        let inside = widened(ray.interval).intersection(chord);
        (!inside.is_empty()).then_some(inside)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_through_the_middle_is_inside_for_the_diameter() {
        let sphere = BoundingSphere { center: [0.0, 0.0, 5.0], radius: 2.0 };
        let inside = sphere.ray_interval(&Ray::new([0.0; 3], [0.0, 0.0, 0.5])).unwrap();
        assert!((inside.t_min - 6.0).abs() < 1e-9 && (inside.t_max - 14.0).abs() < 1e-9);
        assert!(sphere.ray_interval(&Ray::new([2.1, 0.0, 0.0], [0.0, 0.0, 1.0])).is_none());
        assert!(sphere.ray_interval(&Ray::new([2.0, 0.0, 0.0], [0.0, 0.0, 1.0])).is_some());
    }

    #[test]
    fn rays_of_any_length_and_from_anywhere_are_not_lost() {
        let sphere = BoundingSphere { center: [0.0; 3], radius: 1.0 };
        for length in [1e-310, 1e-170, 1.0, 1e160, 1e308] {
            let ray = Ray::new([-3.0, 0.0, 0.0], [length, 0.0, 0.0]);
            assert!(sphere.ray_interval(&ray).is_some(), "{length}");
        }
        for distance in [1e10, 1e100, 1e200, 1e300] {
            let ray = Ray::new([distance, 0.0, distance], [-1.0, 0.0, -1.0]);
            assert!(sphere.ray_interval(&ray).is_some(), "{distance}");
        }
    }

    #[test]
    fn it_holds_its_points() {
        let points = [[1.0, 2.0], [-3.0, 0.5], [0.25, -7.0]];
        let sphere = BoundingSphere::of_points(points);
        for p in points {
            let ray = Ray::through([20.0, 1.0], p.map(f64::from)).with_interval(1.0, 1.0);
            assert!(sphere.ray_interval(&ray).is_some(), "{p:?}");
        }
        let none: [[f32; 2]; 0] = [];
        let ray = Ray::new([0.0, 0.0], [1.0, 0.0]);
        assert!(BoundingSphere::of_points(none).ray_interval(&ray).is_none());
    }
}
