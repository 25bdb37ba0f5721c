//! The foot of the perpendicular was sought by correcting it until a correction was small. In a triangle whose computed
//! normal is all rounding the first one was zero: the foot was taken for a corner, far away from the nearest point.

use kdray::{BuildOptions, Scene};
use kdray_tests::meshes;

#[test]
fn a_point_on_the_edge_of_a_sliver_is_on_it() {
    let tiny = |power: i32| 2.0_f64.powi(-power);
    let b = [1.0, 1.0 + tiny(26), 0.0];
    let c = [1.0 + tiny(27), 1.0 + tiny(26) + tiny(27) + tiny(52), 0.0];
    let scene = Scene::build(meshes::mesh(vec![[[0.0; 3], b, c]]), &BuildOptions::default());
    let scene = scene.expect("one triangle is no trouble");
    let point = b.map(|x| 0.625 * x);
    let found = scene.closest_point(point).expect("the mesh is not empty");
    assert_eq!((found.distance, found.point), (0.0, point), "{found:?}");
    assert!((found.u - 0.625).abs() < 1e-6 && found.v.abs() < 1e-6, "{found:?}");
    assert_eq!(scene.signed_distance(point), Some(0.0));
}
