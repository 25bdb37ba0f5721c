//! A hit behind the ray's origin by less than the smallest f64 got t = -0, which lies in the ray's
//! interval: it was reported, and closed meshes were crossed once too often.

use kdray::primitives::{HitRule, Segments, intersect_triangle};
use kdray::{Ray, ShapeScene};

#[test]
fn a_triangle_a_hair_behind_the_origin_is_not_hit() {
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    for (height, hit) in [(1e-30, false), (0.0, true), (-1e-30, true)] {
        let ray = Ray::new([0.2, 0.2, height], [0.0, 0.0, 1e299]);
        let found = intersect_triangle(&triangle, 0, &ray, HitRule::Touching);
        assert_eq!(found.is_some(), hit, "{height}: {found:?}");
        let line = ray.with_interval(f64::NEG_INFINITY, f64::INFINITY);
        let t = intersect_triangle(&triangle, 0, &line, HitRule::Touching).unwrap().t;
        assert_eq!(t.partial_cmp(&0.0), (-height).partial_cmp(&0.0), "{height}: {t:e}");
    }
}

#[test]
fn a_segment_a_hair_behind_the_origin_is_not_hit() {
    let segments = Segments::new(vec![[[0.0, 0.0], [1.0, 0.0]]]).unwrap();
    let scene = ShapeScene::build(segments, &Default::default()).unwrap();
    for (height, hit) in [(1e-30, false), (0.0, true), (-1e-30, true)] {
        let ray = Ray::new([0.2, height], [0.0, 1e299]);
        assert_eq!(scene.any_hit(&ray), hit, "{height}");
    }
}
