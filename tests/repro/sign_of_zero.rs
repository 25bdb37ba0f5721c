//! Of a hit on an edge u or v can be -0. Packets said 0: not the same to the last bit.

use kdray::primitives::HitArrays;
use kdray::{BuildOptions, RayPacket, Scene};
use kdray_tests::meshes;
use kdray_tests::sets::by_each_set;

#[test]
fn zeros_of_packets_have_the_sign_of_those_of_single_rays() {
    let mesh = meshes::mesh(meshes::grid(4, 2));
    let scene = Scene::build(mesh, &BuildOptions::default()).unwrap();
    by_each_set(&scene).for_each(assert_same_zeros);
}

fn assert_same_zeros(scene: Scene) {
    let places: Vec<[f64; 3]> = (0..256).map(|i| [i % 16, i / 16, 0].map(f64::from)).collect();
    let column = |axis: usize| places.iter().map(|p| 0.25 * p[axis]).collect::<Vec<_>>();
    for eye in [[2.5, 1.5, 6.0], [-1.5, 0.5, 3.0], [2.5, 1.5, -6.0], [9.5, 7.5, -4.0]] {
        let way = |axis: usize| column(axis).iter().map(|x| x - eye[axis]).collect::<Vec<_>>();
        let (x, y, z) = (way(0), way(1), way(2));
        let packet = RayPacket::from(eye, [&x, &y, &z]);
        let mut hits = HitArrays::default();
        scene.packet_closest_hits(&packet, &mut hits);
        for index in 0..packet.len() {
            let bits = [hits.get(index), scene.closest_hit(&packet.ray(index))]
                .map(|hit| hit.map(|hit| [hit.u.to_bits(), hit.v.to_bits()]));
            assert_eq!(bits[0], bits[1], "{:?}", packet.ray(index));
        }
    }
}
