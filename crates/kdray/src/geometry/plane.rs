//! A hyperplane, and where a ray meets it (S2 of the founding lecture).

use super::Ray;

/// The hyperplane of the points P with `normal · P + offset = 0`: in 2-D the lecture's line
/// Ax + By + C = 0, in 3-D a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane<const K: usize> {
    /// The coefficients A, B, … of the coordinates; any length but zero.
    pub normal: [f64; K],
    /// The constant C.
    pub offset: f64,
}

impl<const K: usize> Plane<K> {
    /// The plane perpendicular to `axis` at `position`, such as a kd-tree splits with.
    pub fn perpendicular(axis: usize, position: f64) -> Self {
        let mut normal = [0.0; K];
        normal[axis] = 1.0;
        Self { normal, offset: -position }
    }

    /// The t* at which the line of `ray` meets the plane, whatever the ray's interval: the
    /// solution of `normal · (E + D t*) + offset = 0`. `None` if the ray is parallel to the plane.
    ///
    /// The lecture's two lines:
    /// ```
    /// use kdray::geometry::{Plane, Ray};
    /// let ray = Ray::new([0.0, 0.0], [5.0, 4.0]);
    /// let vertical = Plane { normal: [1.0, 0.0], offset: -10.0 }; // x − 10 = 0
    /// let horizontal = Plane { normal: [0.0, 1.0], offset: -6.0 }; // y − 6 = 0
    /// assert_eq!(vertical.ray_parameter(&ray), Some(2.0));
    /// assert_eq!(horizontal.ray_parameter(&ray), Some(1.5));
    /// ```
    pub fn ray_parameter(&self, ray: &Ray<K>) -> Option<f64> {
        let along = dot(&self.normal, &ray.direction);
        (along != 0.0).then(|| -(dot(&self.normal, &ray.origin) + self.offset) / along)
    }
}

fn dot<const K: usize>(a: &[f64; K], b: &[f64; K]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lecture_example_meets_the_horizontal_line_first() {
        let ray = Ray::new([0.0, 0.0], [5.0, 4.0]);
        let t_x = Plane::perpendicular(0, 10.0).ray_parameter(&ray);
        let t_y = Plane::perpendicular(1, 6.0).ray_parameter(&ray);
        assert_eq!((t_x, t_y), (Some(2.0), Some(1.5)));
        assert!(t_x > t_y);
    }

    #[test]
    fn a_parallel_ray_meets_no_plane() {
        let ray = Ray::new([0.0, 0.0, 0.0], [1.0, -0.0, 2.0]);
        assert_eq!(Plane::perpendicular(1, 3.0).ray_parameter(&ray), None);
        assert_eq!(Plane::perpendicular(2, 3.0).ray_parameter(&ray), Some(1.5));
    }
}
