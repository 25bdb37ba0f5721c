//! The f32 filter knew what underflow may take of T, but not of den, which it multiplies by t: tiny
//! triangles that are hit at a huge t were lost.

use kdray::{BuildOptions, InstructionSet, Ray, Scene, TriangleMesh};

#[test]
fn a_tiny_triangle_is_hit_from_far_away() {
    let e = 8.74138e-19;
    let tiny = [[0.0, 0.0, 0.0], [e, 0.0, 0.0], [0.0, e, 0.0]];
    // Makes the reach so large that the ray starts within it.
    let wide = 2.0_f32.powi(29);
    let far = [[wide, wide, wide], [wide, 0.0, wide], [0.0, wide, wide]];
    let mesh = TriangleMesh::from_soup([tiny, far]).unwrap();
    let scene = Scene::build(mesh, &BuildOptions::default()).unwrap();
    assert!(scene.wide_tree().is_some());
    let inside = f64::from(e) / 4.0;
    let ray = Ray::new([inside, inside, -(2.0_f64.powi(31))], [0.0, 0.0, 2.0_f64.powi(-16)])
        .with_interval(0.0, 2.0_f64.powi(47) * (1.0 + 2.0_f64.powi(-20)));
    let naive = scene.shapes().naive().closest_hit(&ray);
    assert_eq!(naive.map(|hit| hit.primitive_id), Some(0));
    for set in InstructionSet::available() {
        let scene = scene.clone().with_instructions(set);
        assert_eq!(scene.closest_hit(&ray), naive, "{set}");
        assert!(scene.any_hit(&ray), "{set}");
    }
}
