//! Whether a triangle has an area was told by a rounded cross product: slivers that have one counted for nothing in winding
//! numbers, and corners on a line had a thickness.

use kdray::{BuildOptions, Scene, Side, TriangleMesh};

fn scene(soup: impl IntoIterator<Item = [[f64; 3]; 3]>) -> Scene<f64> {
    let mesh = TriangleMesh::from_soup(soup).expect("it is finite");
    Scene::build(mesh, &BuildOptions::default()).expect("it is small")
}

#[test]
fn a_sliver_whose_normal_is_computed_as_zero_has_two_sides() {
    let a = [-1.030_589_983_033_553_6, -1.025_445_860_993_461, 0.0];
    let c = [0.270_451_279_648_476_6, 0.269_101_339_894_243_9, 0.0];
    let scene = scene([[a, a.map(|x| -x), c]]);
    let at = |z: f64| scene.winding_number([-1.410_5e-18, 1.417_7e-18, z]);
    assert!((at(-1e-24) - at(1e-24)).abs() > 0.9, "{} and {}", at(-1e-24), at(1e-24));
}

#[test]
fn corners_on_a_line_have_no_thickness() {
    let a = [-1.806_684_180_854_961, -2.452_290_924_610_869, 0.0];
    let b = [1.204_456_120_569_974, 1.634_860_616_407_246, 0.0];
    let c = [2.408_912_241_139_948, 3.269_721_232_814_492, 0.0];
    let sheet = [[-9.0, -9.0, 1.0], [9.0, -9.0, 1.0], [0.0, 9.0, 1.0]];
    let scene = scene([[a, b, c], sheet, sheet.map(|[x, y, _]| [x, y, -1.0])]);
    for side in [Side::Front, Side::Back] {
        assert_eq!(scene.thickness(0, 0.2, 0.2, side), None);
    }
    assert_eq!(scene.thickness(1, 0.25, 0.25, Side::Front), Some(2.0));
}
