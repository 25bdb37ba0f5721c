//! From so near to a corner that the square of the distance underflows, every triangle there seemed to cover a quarter of
//! the sphere, whatever its angle; so a point beside a vertex of an open mesh was on the wrong side.

use kdray::{BuildOptions, Scene, TriangleMesh};

#[test]
fn beside_a_corner_a_triangle_covers_its_angle() {
    let corners = [[0.0_f32; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    for turned in 0..3 {
        let mut soup = vec![corners];
        soup[0].rotate_left(turned);
        let mesh = TriangleMesh::from_soup(soup).unwrap();
        let scene = Scene::build(mesh, &BuildOptions::default()).unwrap();
        for z in [1e-9, 1e-99, 1e-101, 1e-154, 1e-161, 1e-162, 1e-163, 1e-300, 5e-324] {
            let [front, back] = [z, -z].map(|z| scene.winding_number([0.0, 0.0, z]));
            let is_right = (front + 0.125).abs() < 1e-8 && (back - 0.125).abs() < 1e-8;
            assert!(is_right, "{z:e}: {front}, {back}");
        }
    }
}
