//! Rays to a common target are bounded from there; the closest hit was sought from there too, and the
//! farthest one was found. Packets leave such rays since, all of them; whether one is hit at all they
//! still tell.

use kdray::{BuildOptions, RayPacket, Scene};
use kdray_tests::meshes;
use kdray_tests::sets::{assert_packet_agrees, count_with_vectors};

#[test]
fn the_closest_hit_is_the_one_closest_to_the_origin() {
    let wall = |z: f32| [[-9.0, -9.0, z], [9.0, -9.0, z], [0.0, 9.0, z]];
    let mesh = meshes::mesh(vec![wall(1.0), wall(2.0), wall(3.0)]);
    let scene = Scene::build(mesh, &BuildOptions::default()).unwrap();
    let x: Vec<f64> = (0..64).map(|i| 0.01 * f64::from(i)).collect();
    let (y, z) = (vec![0.0; 64], vec![4.0; 64]);
    let packet = RayPacket::towards([0.0; 3], [&x, &y, &z]);
    let answered = assert_packet_agrees(&scene, &packet);
    assert_eq!(answered.closest, 0, "from the wrong end?");
    assert_eq!(answered.any, 64 * count_with_vectors());
}
