//! A tree file of a triangle that is narrower than what rounding may do to a cut was refused as forged: cut once
//! more, with room for rounding, it came out longer than the builder, which had cut it exactly, had found it.

use kdray::{BuildOptions, Scene};
use kdray_tests::meshes;

#[test]
fn narrow_triangles_are_verified() {
    for width in [1.4837e-41, 1e-30, 1e-13, 1e-12, 1e-11] {
        let speck = [[0.0; 3], [0.0; 3], [0.1 * width, 0.0, 0.0]];
        let mut soup = vec![[[0.0; 3]; 3]; 7];
        soup.extend([speck, [[0.0; 3], [0.0, 0.0, 1.0], [width, 0.0, 0.0]]]);
        let scene = Scene::build(meshes::mesh(soup), &BuildOptions::default()).unwrap();
        assert!(scene.wide_tree().is_some());
        assert_eq!(scene.verify(), Ok(()), "{width}");
    }
}

#[test]
fn needles_are_verified() {
    for seed in 0..20 {
        let scene = Scene::build(meshes::mesh(meshes::needles(60, seed)), &BuildOptions::default());
        assert_eq!(scene.unwrap().verify(), Ok(()), "{seed}");
    }
}
