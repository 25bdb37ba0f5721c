//! Parallel packets ended each ray at t = 2^60. Where directions are short, that is near.

use kdray::{BuildOptions, RayPacket, Scene};
use kdray_tests::meshes;
use kdray_tests::sets::assert_packet_agrees;

#[test]
fn what_lies_many_short_directions_away_is_hit() {
    let z = 3e6_f32;
    let wall = [[-z, -z, z], [3.0 * z, -z, z], [-z, 3.0 * z, z]];
    let scene = Scene::build(meshes::mesh(vec![wall]), &BuildOptions::default()).unwrap();
    let x: Vec<f64> = (0..64).map(|i| 1e4 * f64::from(i)).collect();
    let y = vec![0.25; 64];
    for (length, from) in [(2e-12, 0.0), (1e-7, -5e11), (1e11, -1e3)] {
        let origins = vec![from; 64];
        let packet = RayPacket::along([0.0, 0.0, length], [&x, &y, &origins]);
        assert!((0..64).all(|index| scene.any_hit(&packet.ray(index))), "{length:e}");
        assert_packet_agrees(&scene, &packet);
    }
}
