//! Where all triangles of a cluster are so small, beside the mesh, that the squares of their areas are zero, its
//! middle was NaN, and so was the winding number of all points.

use kdray::{BuildOptions, Scene, TriangleMesh};

#[test]
fn winding_numbers_around_tiny_triangles_are_numbers() {
    let tiny = 1e-150;
    let speck = [[0.0; 3], [tiny, 0.0, 0.0], [0.0, tiny, 0.0]];
    let far = [[1.0; 3]; 3];
    let mesh = TriangleMesh::<f64>::from_soup([speck, far]).unwrap();
    let scene = Scene::build(mesh, &BuildOptions::default()).unwrap();
    assert!(scene.winding_number([0.5; 3]).abs() < 1e-9);
    let near = scene.winding_number([0.25 * tiny, 0.25 * tiny, -1e-3 * tiny]);
    assert!((near - 0.5).abs() < 0.01, "{near}");
}
