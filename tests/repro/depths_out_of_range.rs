//! The depth of a triangle in whose plane the common origin of a packet nearly lies overflowed: rays that are not there were
//! asked for, which panicked, or the triangle was lost. And the normal of a tiny triangle lost its digits, so that another
//! one was taken for nearer.

use kdray::{BuildOptions, RayPacket, Scene};
use kdray_tests::meshes;
use kdray_tests::sets::assert_packet_agrees;

/// Some rays around the z axis from there, of a number that leaves lanes without one.
fn assert_alike(soup: Vec<[[f32; 3]; 3]>, from: [f64; 3], spread: f64) {
    let scene = Scene::build(meshes::mesh(soup), &BuildOptions::default());
    let scene = scene.expect("the mesh is small");
    let x: Vec<f64> = (0..9).map(|i| spread * f64::from(i)).collect();
    let (y, z) = (vec![2.0 * spread; 9], vec![1.0; 9]);
    let packet = RayPacket::from(from, [&x, &y, &z]);
    assert!((0..9).all(|index| scene.any_hit(&packet.ray(index))), "{from:?}");
    assert_packet_agrees(&scene, &packet);
}

#[test]
fn triangles_in_whose_plane_the_origin_nearly_lies_are_hit() {
    let at = |z: f32| [[0.0, 0.0, z], [1024.0, 0.0, z], [0.0, 1024.0, z]];
    for bits in [1, 1 << 10, 1 << 20, (1 << 21) + 1, 1 << 22, 1 << 23] {
        let height = f32::from_bits(bits);
        assert_alike(vec![at(height)], [0.0; 3], 0.01);
        assert_alike(vec![at(0.0)], [0.0, 0.0, -f64::from(height)], 0.01);
    }
    for exponent in 100..150 {
        assert_alike(vec![at(0.0)], [0.0, 0.0, -(2.0_f64.powi(-exponent))], 0.01);
    }
}

#[test]
fn the_nearer_of_a_wall_and_a_tiny_triangle_is_hit() {
    let s = 1.702_751_3e-21;
    for gap in [100.0, 200.0, 400.0] {
        let wall = [[-100.0, -100.0, gap], [200.0, -100.0, gap], [-100.0, 200.0, gap]];
        let tiny = [[-s, -s, 0.0], [2.0 * s, -s, 0.0], [-s, 2.0 * s, 0.0]];
        assert_alike(vec![wall, tiny], [0.0, 0.0, -(2.0_f64.powi(25))], 0.0);
    }
}
