//! In a large f64 mesh a ray of a short direction meets a triangle at a t that no f64 is. The tree's coordinates are smaller, and
//! t with them, so `any_hit` and `count` found a hit that `closest_hit` and `all_hits` did not.

use kdray::{BuildOptions, Ray, Scene, TriangleMesh};
use kdray_tests::sets::by_each_set;

#[test]
fn what_is_beyond_all_t_is_not_hit() {
    let p = 2.0_f64.powi(1010);
    let mesh = TriangleMesh::from_soup([[[0.0, -p, -p], [0.0, p, -p], [0.0, 0.0, p]]]).unwrap();
    let scene = Scene::build(mesh, &BuildOptions::default()).unwrap();
    // t = 5 · 2^1023 at -5 p, and the largest power of two just before 2 p.
    for (from, expected) in [(-5.0, false), (-2.0, false), (-1.0, true), (5.0, false), (1.0, true)]
    {
        let length = if from < 0.0 { 2.0_f64.powi(-13) } else { -(2.0_f64.powi(-13)) };
        let ray = Ray::new([from * p, 0.0, 0.0], [length, 0.0, 0.0]);
        assert_eq!(scene.shapes().any_hit(&ray), expected, "{from}");
        for scene in by_each_set(&scene) {
            let mut counts = [0; 9];
            scene.counts(&[ray; 9], &mut counts);
            let mut found = [false; 9];
            scene.any_hits(&[ray; 9], &mut found);
            assert_eq!(scene.closest_hit(&ray).is_some(), expected, "{from}");
            assert_eq!(scene.any_hit(&ray), expected, "{from}");
            assert_eq!(found, [expected; 9], "{from}");
            assert_eq!(counts, [usize::from(expected); 9], "{from}");
            assert_eq!(scene.count(&ray), usize::from(expected), "{from}");
        }
    }
}
