//! Triangles that count how often they are tested.

use kdray::{
    Aabb, Hit, Ray, TriangleMesh,
    primitives::{HitRule, Intersect, Primitives},
};
use std::sync::atomic::{AtomicU64, Ordering};

/// A mesh whose tests are counted, whoever asks for them. The naive answer has no trace of its
/// own, and what it tests depends on which rays meet the box.
pub(super) struct Counted<'a> {
    mesh: &'a TriangleMesh,
    tests: AtomicU64,
}

impl<'a> Counted<'a> {
    pub(super) fn new(mesh: &'a TriangleMesh) -> Self {
        Self { mesh, tests: AtomicU64::new(0) }
    }

    /// How many tests there were.
    pub(super) fn tests(&self) -> u64 {
        self.tests.load(Ordering::Relaxed)
    }
}

impl Primitives<3> for Counted<'_> {
    fn count(&self) -> usize {
        self.mesh.count()
    }

    fn bounds(&self, id: u32) -> Aabb<3> {
        self.mesh.bounds(id)
    }
}

impl Intersect<3> for Counted<'_> {
    fn intersect(&self, id: u32, ray: &Ray, rule: HitRule, report: &mut impl FnMut(Hit)) {
        self.tests.fetch_add(1, Ordering::Relaxed);
        self.mesh.intersect(id, ray, rule, report);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kdray::traverse::Naive;

    #[test]
    fn a_ray_beside_the_box_tests_nothing() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let mesh = TriangleMesh::from_soup([corners; 3]).unwrap();
        let counted = Counted::new(&mesh);
        let naive = Naive::new(&counted, mesh.bounds(0));
        assert!(!naive.any_hit(&Ray::new([5.0, 5.0, 1.0], [0.0, 0.0, -1.0])));
        assert_eq!(counted.tests(), 0);
        assert!(naive.any_hit(&Ray::new([0.25, 0.25, 1.0], [0.0, 0.0, -1.0])));
        assert_eq!(counted.tests(), 3);
    }
}
