//! Where the normal of a sliver is all rounding, the distance of a point on it came out larger than rounding was thought to
//! make it, and nobody asked whether it lies on the sliver.

use kdray::{BuildOptions, Scene};
use kdray_tests::meshes;

#[test]
fn a_point_in_a_sliver_is_on_it() {
    let sliver: [[f64; 3]; 3] = [
        [0.0; 3],
        [-2194448617627856.0, -767076648634564.0, 1394158766701016.0],
        [-2194448617627696.0, -767076648634576.0, 1394158766701064.0],
    ];
    let [a, b, c] = sliver;
    let point = [0, 1, 2].map(|k| 0.5 * a[k] + 0.25 * b[k] + 0.25 * c[k]);
    assert_eq!(point, [-1097224308813888.0, -383538324317285.0, 697079383350520.0]);
    let scene = Scene::build(meshes::mesh(vec![sliver]), &BuildOptions::default());
    let scene = scene.expect("one triangle is no trouble");
    let found = scene.closest_point(point).expect("the mesh is not empty");
    assert_eq!((found.distance, found.point), (0.0, point), "{found:?}");
    assert_eq!(scene.signed_distance(point), Some(0.0));
}
