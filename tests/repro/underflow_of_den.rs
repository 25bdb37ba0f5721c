//! The f32 filter knew what underflow may take of T, but not of den, which it multiplies by t: tiny
//! triangles that are hit at a huge t were lost.

use kdray::{BuildOptions, InstructionSet, Ray, Scene, TriangleMesh};

#[test]
fn a_tiny_triangle_is_hit_from_far_away() {
    let e = 8.74138e-19;
    is_hit_from_far_away([e, e]);
}

#[test]
fn a_slender_triangle_is_hit_from_far_away() {
    // Not of f32, which has no 2^140 to take the inverse of.
    is_hit_from_far_away([2.0_f32.powi(29), 2.0_f64.powi(-140) as f32]);
}

/// Of a triangle with legs of those lengths.
fn is_hit_from_far_away([m, n]: [f32; 2]) {
    let triangle = [[0.0, 0.0, 0.0], [m, 0.0, 0.0], [0.0, n, 0.0]];
    // Makes the reach so large that the ray starts within it.
    let wide = 2.0_f32.powi(29);
    let far = [[wide, wide, wide], [wide, 0.0, wide], [0.0, wide, wide]];
    let mesh = TriangleMesh::from_soup([triangle, far]).expect("finite");
    let scene = Scene::build(mesh, &BuildOptions::default()).expect("a small mesh");
    assert!(scene.wide_tree().is_some());
    let inside = [f64::from(m) / 4.0, f64::from(n) / 4.0, -(2.0_f64.powi(31))];
    let ray = Ray::new(inside, [0.0, 0.0, 2.0_f64.powi(-16)])
        .with_interval(0.0, 2.0_f64.powi(47) * (1.0 + 2.0_f64.powi(-20)));
    let naive = scene.shapes().naive().closest_hit(&ray);
    assert_eq!(naive.map(|hit| hit.primitive_id), Some(0));
    for set in InstructionSet::available() {
        let scene = scene.clone().with_instructions(set);
        assert_eq!(scene.closest_hit(&ray), naive, "{set}");
        assert!(scene.any_hit(&ray), "{set}");
    }
}
