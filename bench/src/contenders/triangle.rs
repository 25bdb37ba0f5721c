//! A triangle test for crates that bring none, or one that passes over back faces.

use crate::rays::Ray;
use glam::Vec3A;

/// A corner and two edges (Möller and Trumbore 1997).
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    corner: Vec3A,
    edges: [Vec3A; 2],
}

/// A ray as the test takes it.
#[derive(Clone, Copy, Debug)]
pub(super) struct TestRay {
    origin: Vec3A,
    direction: Vec3A,
}

impl TestRay {
    pub(super) fn new(ray: &Ray) -> Self {
        Self { origin: ray.origin.into(), direction: ray.direction.into() }
    }
}

impl Triangle {
    pub(super) fn new([a, b, c]: [[f32; 3]; 3]) -> Self {
        let [a, b, c] = [a, b, c].map(Vec3A::from);
        Self { corner: a, edges: [b - a, c - a] }
    }

    /// The t of the hit, from either side, if it is between 0 and `t_max`.
    #[inline]
    pub(super) fn hit(&self, ray: &TestRay, t_max: f32) -> Option<f32> {
        let [e1, e2] = self.edges;
        let p = ray.direction.cross(e2);
        let inverse = 1.0 / e1.dot(p);
        let s = ray.origin - self.corner;
        let u = s.dot(p) * inverse;
        let q = s.cross(e1);
        let v = ray.direction.dot(q) * inverse;
        let t = e2.dot(q) * inverse;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0 && t <= t_max).then_some(t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_sides_are_hit_within_the_ray() {
        let triangle = Triangle::new([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        for z in [2.0, -2.0] {
            let ray = Ray { origin: [0.2, 0.3, z], direction: [0.0, 0.0, -z / 2.0], t_max: 9.0 };
            let ray = TestRay::new(&ray);
            assert_eq!(triangle.hit(&ray, 9.0), Some(2.0));
            assert_eq!(triangle.hit(&ray, 1.5), None);
        }
        let beside = Ray { origin: [0.8, 0.3, 1.0], direction: [0.0, 0.0, -1.0], t_max: 9.0 };
        assert_eq!(triangle.hit(&TestRay::new(&beside), 9.0), None);
    }
}
