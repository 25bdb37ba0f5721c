//! Where the origin of a ray is so near to a corner, or an end of its interval so near to zero, that bounds of the kernels'
//! errors underflow, hits were lost.

use kdray::{BuildOptions, Ray, Scene};
use kdray_tests::meshes;
use kdray_tests::sets::by_each_set;

fn assert_hit(triangle: [[f32; 3]; 3], ray: &Ray) {
    let scene = Scene::build(meshes::mesh(vec![triangle]), &BuildOptions::default());
    let scene = scene.expect("one triangle is no trouble");
    let expected = scene.shapes().closest_hit(ray);
    assert!(expected.is_some(), "{ray:?}");
    for scene in by_each_set(&scene) {
        assert_eq!(scene.closest_hit(ray), expected, "{ray:?}");
        assert_eq!(
            (scene.any_hit(ray), scene.count(ray)),
            (true, scene.shapes().count(ray)),
            "{ray:?}"
        );
    }
}

#[test]
fn the_end_of_an_interval_is_tiny() {
    let tiny = |exponent: i32| 2.0_f64.powi(-exponent);
    for (edge, height, end, pace) in
        [(4096.0, 135, 151, 65536.0), (2.0_f32.powi(29), 149, 155, 1024.0)]
    {
        let triangle = [[0.0; 3], [edge, 0.0, 0.0], [0.0, edge, 0.0]];
        let place = 0.25 * f64::from(edge);
        for x in [0.0, place] {
            let ray = Ray::new([x, x, -tiny(height)], [0.0, 0.0, pace]);
            assert_hit(triangle, &ray.with_interval(0.0, tiny(end)));
            let ray = Ray::new([x, x, tiny(height)], [0.0, 0.0, pace]);
            assert_hit(triangle, &ray.with_interval(-tiny(end), 1.0));
        }
    }
}

#[test]
fn the_origin_is_a_hair_beside_a_corner() {
    let triangle = [
        [0.0; 3],
        [263_038_864.0, 78_036_528.0, 207_815_728.0],
        [-66_365_328.0, 249_840_080.0, 251_001_808.0],
    ];
    let origin = [3001, 5003, 7001].map(|x: u64| f64::from(x as u32) * 2.0_f64.powi(-149));
    assert_hit(triangle, &Ray::new(origin, [0.0, -1.0, 0.0]));
}
