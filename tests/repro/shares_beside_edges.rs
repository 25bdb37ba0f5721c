//! All digits of a solid angle cancel within some units in the last place of an edge. Its sign was that of the rest,
//! and points inside open meshes were outside.

use kdray::primitives::solid_angle;
use kdray::{BuildOptions, Scene, TriangleMesh};

#[test]
fn a_triangle_beside_whose_edge_a_point_lies_covers_what_it_does() {
    let point = [-0.9121840934552857, 0.15610172676821898, -0.005303439344039874];
    let corners = [
        [-0.8310897017614793, -0.386123664619777, 0.7037040629658278],
        [-0.9934124819124652, 0.6992230672588233, -0.7154824740932333],
        [0.8864765758201627, 0.35827598537076977, -0.13445305370389304],
    ];
    // By an arithmetic of eighty digits.
    assert!((solid_angle(point, corners) - 0.48020).abs() < 1e-4);
}

#[test]
fn a_point_beside_the_diagonal_of_an_open_cube_is_inside() {
    let above = [
        [-0.11383267492055893, 0.8576487302780151, 0.038481008261442184],
        [0.7406412363052368, 0.3790101408958435, 0.2404201328754425],
        [-0.6188482642173767, 0.18345099687576294, 0.5773842334747314],
        [0.23562563955783844, -0.2951875925064087, 0.7793233394622803],
    ];
    let below = [3, 2, 1, 0].map(|i: usize| above[i].map(|x: f64| -x));
    let vertices = [above, below].concat();
    let quads = [[0, 2, 3, 1], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let faces = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let vertices = vertices.iter().map(|vertex| vertex.map(|x| x as f32)).collect();
    let mesh = TriangleMesh::new(vertices, faces).expect("a cube without its lid");
    let scene = Scene::build(mesh, &BuildOptions::default()).expect("ten triangles are no trouble");
    let point = [0.06278776664852333, 0.27499136614868375, 0.4129116463335805];
    assert!((scene.winding_number(point) - 0.936).abs() < 0.01, "{}", scene.winding_number(point));
    assert!(scene.contains(point));
}

#[test]
fn beside_a_sliver_it_is_the_closest_edge_that_counts() {
    let point = [0.06286314096281795, 1.6503363672302601e-13, -1.9750280407322104e-14];
    let corners = [
        [0.0; 3],
        [1.0, 0.0, 0.0],
        [0.6387059092521667, 1.6767847960813542e-12, -2.0066800055385664e-13],
    ];
    // By an arithmetic of 120 digits.
    assert!((solid_angle(point, corners).abs() - 0.49931).abs() < 1e-4);
}
