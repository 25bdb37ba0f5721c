//! The triangle test's filter bounded d · ē · M, but not s x e1: with a huge origin and a short
//! direction that overflowed, and infinities and NaN were taken for sure signs.

use kdray::primitives::{HitRule, intersect_triangle};
use kdray::{Ray, Scene, TriangleMesh};

#[test]
fn a_ray_from_very_far_meets_the_edge_it_passes_through() {
    let e = 1.2e38_f32;
    let soup = [[[0.0, 0.0, 0.0], [0.0, 0.0, e], [e, 0.0, 0.0]]];
    let scene = Scene::build(TriangleMesh::from_soup(soup).unwrap(), &Default::default()).unwrap();
    // Through (0, 0, 1) of the first edge, but for the rounding of the direction.
    let ray = Ray::new([-1e270, -2e270, 1.0], [1e-20, 2e-20, 0.0]);
    let exact = kdray_tests::oracle::exact_triangle_hit(&soup[0], 0, &ray, HitRule::Touching);
    assert!(exact.is_some());
    for scene in kdray_tests::sets::by_each_set(&scene) {
        assert!(scene.closest_hit(&ray).is_some());
    }
}

#[test]
fn a_ray_that_passes_by_very_far_away_misses() {
    let triangle = [[0.0, 0.0, 0.0], [1e38_f32, 0.0, 0.0], [0.0, 1e38, 0.0]];
    let ray = Ray::new([1e280, 1.0, 1e280], [0.0, 0.0, -1e-20]);
    assert_eq!(intersect_triangle(&triangle, 0, &ray, HitRule::Touching), None);
}
