//! A ray whose interval begins at NaN hits nothing, but its hits after a given one were those of a ray that begins there.

use kdray::{BuildOptions, Ray, Scene};
use kdray_tests::meshes;

#[test]
fn nothing_comes_after_a_hit_of_a_ray_that_hits_nothing() {
    let scene = Scene::build(meshes::mesh(meshes::boxes(2)), &BuildOptions::default()).unwrap();
    let ray = Ray::new([-1.0, 0.3, 0.4], [1.0, 0.0, 0.0]);
    let hits: Vec<_> = scene.all_hits(&ray).collect();
    assert!(hits.len() > 1);
    assert_eq!(scene.all_hits_after(&ray, &hits[0]).count(), hits.len() - 1);
    for (t_min, t_max) in [(f64::NAN, f64::INFINITY), (0.0, f64::NAN), (f64::NAN, f64::NAN)] {
        let ray = ray.with_interval(t_min, t_max);
        assert_eq!(scene.all_hits(&ray).count(), 0);
        assert_eq!(scene.all_hits_after(&ray, &hits[0]).count(), 0);
        assert_eq!(scene.all_touched_after(&ray, &hits[0]).count(), 0);
    }
}
