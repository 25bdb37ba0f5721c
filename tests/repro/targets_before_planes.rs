//! Where a triangle lies by a hair behind the target of a packet, the t of a hit may be reported as 1, and it counts. The packet
//! knew better on which side the target lies, and lost it.

use kdray::{BuildOptions, RayPacket, Scene};
use kdray_tests::meshes;
use kdray_tests::sets::assert_packet_agrees;

#[test]
fn what_is_hit_by_rounding_is_hit_in_packets_too() {
    let triangle: [[f64; 3]; 3] = [
        [2.46778049384222e-11, -1.667561054519151e-11, -1.979201691426624e-9],
        [0.001030709478072822, 0.0010070035932585597, 0.0010527231497690082],
        [-0.001056585693731904, -0.0009895183611661196, 0.0010226161684840918],
    ];
    let scene = Scene::build(
        meshes::mesh(vec![triangle.map(|p| p.map(|x| x as f32))]),
        &BuildOptions::default(),
    )
    .unwrap();
    let from = [-1.104463248886316, 1.145127725619604, -1.1377210579053192];
    // Around there, too, and from nearer or farther away on the same line.
    let origins = |k: usize| -> Vec<f64> {
        (0..64).map(|i| from[k] * if i == 0 { 1.0 } else { 0.5 + 0.03 * f64::from(i) }).collect()
    };
    let (x, y, z) = (origins(0), origins(1), origins(2));
    let packet = RayPacket::towards([0.0; 3], [&x, &y, &z]);
    assert!(scene.any_hit(&packet.ray(0)));
    assert_packet_agrees(&scene, &packet);
}
