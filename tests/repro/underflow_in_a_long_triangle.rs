//! What underflows in a product of the ray's offset and one edge is multiplied by the other edge. In a triangle of 1e100
//! that is far more than the bound for the error of t had room for: t had the wrong sign, and the hit was lost.

use kdray::{BuildOptions, Ray, Scene};
use kdray_tests::meshes;

#[test]
fn the_sign_of_t_is_right() {
    let triangle = [[0.0; 3], [1e100, 1e-170, 0.0], [1e-179, 0.0, 1e100]];
    let scene = Scene::build(meshes::mesh::<f64>(vec![triangle]), &BuildOptions::default());
    let scene = scene.expect("one triangle is no trouble");
    for (length, t) in [(1.0, f64::from_bits(1)), (1e-200, 1e-240)] {
        let ray = Ray::new([1e-170, 0.0, 1e99], [0.0, length, 0.0]);
        let hits: Vec<_> = scene.all_touched(&ray).collect();
        assert_eq!(hits.len(), 1, "{ray:?}");
        assert!((hits[0].t - t).abs() <= 1e-3 * t, "{hits:?}");
        assert_eq!(scene.closest_hit(&ray), Some(hits[0]));
        let back = Ray::new([1e-170, 0.0, 1e99], [0.0, -length, 0.0]);
        assert_eq!(scene.closest_hit(&back), None);
    }
}
