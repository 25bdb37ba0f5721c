//! The sphere as a bounding volume.

use super::{Aabb, BoundingVolume, Interval, Ray};

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
}

impl<const K: usize> BoundingVolume<K> for BoundingSphere<K> {
    /// Solves |E + D t − center|² = radius² after moving the origin to the point of the line
    /// nearest to the centre, where the quadratic has no linear term to cancel with.
    fn ray_interval(&self, ray: &Ray<K>) -> Option<Interval> {
        let to_center: [f64; K] = std::array::from_fn(|k| self.center[k] - ray.origin[k]);
        let dot = |a: &[f64; K], b: &[f64; K]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        let length_squared = dot(&ray.direction, &ray.direction);
        let t_nearest = dot(&to_center, &ray.direction) / length_squared;
        let nearest = ray.at(t_nearest);
        let off: [f64; K] = std::array::from_fn(|k| self.center[k] - nearest[k]);
        // What rounding may have done to `nearest` is made good by a wider sphere.
        let scale = to_center.iter().chain(&self.center).fold(self.radius, |m, x| m.max(x.abs()));
        let radius = self.radius + 16.0 * f64::EPSILON * scale;
        let half_chord_squared = radius * radius - dot(&off, &off);
        if self.radius < 0.0 || half_chord_squared < 0.0 {
            return None;
        }
        let half = (half_chord_squared / length_squared).sqrt();
        let inside = Interval { t_min: t_nearest - half, t_max: t_nearest + half };
        let inside = inside.intersection(ray.interval);
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
