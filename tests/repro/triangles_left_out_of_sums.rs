//! Parts of an open mesh so small, beside the rest, that areas underflow: their triangles were left out of winding
//! numbers, or counted with the few digits that were left of their areas, so that nothing was inside of them.

use kdray::{BuildOptions, Scene, TriangleMesh};
use kdray_tests::meshes::{Soup, mesh, moved, sphere};
use kdray_tests::points::{corners, naive_winding_number};
use kdray_tests::sets::by_each_set;

/// A ball of that size, and a triangle as far away, and as large, as `reach`.
fn open_mesh(size: f64, reach: f64) -> TriangleMesh<f64> {
    let ball: TriangleMesh<f64> = moved(&sphere(8), |p| p.map(|x| size * x));
    let mut soup: Soup<f64> =
        (0..ball.triangles().len() as u32).map(|id| corners(&ball, id)).collect();
    soup.push([[1.0, 2.0, 3.0], [1.5, 2.0, 3.0], [1.0, 2.5, 3.0]].map(|p| p.map(|x| reach * x)));
    mesh(soup)
}

#[test]
fn tiny_balls_have_an_inside() {
    let small = [1e-70, 1e-100, 1e-150, 1e-155, 1e-160, 1e-161, 1e-162, 1e-200, 1e-300];
    let beside_one = small.map(|size| (size, 1.0));
    for (size, reach) in beside_one.into_iter().chain([(1.0, 1e200), (1e-100, 1e300)]) {
        let mesh = open_mesh(size, reach);
        let scene = Scene::build(mesh.clone(), &BuildOptions::default()).unwrap();
        for away in [0.0, 0.5, 0.9, 1.1, 2.0, 3.0, 10.0, 1e10] {
            let point = [0.6, 0.0, 0.8].map(|x| size * away * x);
            assert_eq!(scene.contains(point), away < 1.0, "{size:e}, {away}");
            let sum = naive_winding_number(&mesh, point);
            for scene in by_each_set(&scene) {
                let found = scene.winding_number(point);
                assert!((found - sum).abs() < 0.01, "{size:e}, {away}: {found} for {sum}");
            }
        }
    }
}
