//! The lanes behind the last ray of a packet took part after all: what was surely hit was noted for them
//! too, as their far end was not that of a dead ray; and vectors behind the last one kept what the packet
//! before had left there. Where the filter could not tell, rays that do not exist were asked for: a panic.

use kdray::primitives::HitArrays;
use kdray::{BuildOptions, RayPacket, Scene};
use kdray_tests::meshes;
use kdray_tests::sets::by_each_set;

/// A triangle at that height, through whose edge the z axis goes.
fn at_an_edge(z: f32) -> [[f32; 3]; 3] {
    [[0.0, -1.0, z], [0.0, 1.0, z], [1.0, 0.0, z]]
}

fn around(z: f32) -> [[f32; 3]; 3] {
    [[-3.0, -1.0, z], [3.0, -1.0, z], [0.0, 3.0, z]]
}

fn scene(soup: Vec<[[f32; 3]; 3]>) -> Scene {
    Scene::build(meshes::mesh(soup), &BuildOptions::default()).expect("the mesh is small")
}

#[test]
fn lanes_of_the_last_vector() {
    let scene = scene(vec![around(3.0), at_an_edge(2.0), at_an_edge(1.0)]);
    let packet = RayPacket::from([0.0; 3], [&[0.0], &[0.0], &[1.0]]);
    for scene in by_each_set(&scene) {
        let mut hits = HitArrays::default();
        scene.packet_closest_hits(&packet, &mut hits);
        assert_eq!(hits.get(0), scene.closest_hit(&packet.ray(0)));
    }
}

#[test]
fn vectors_behind_the_last() {
    // Seen edge-on from the origin.
    let scene = scene(vec![[[0.0, 0.0, 1.0], [0.0, 0.0, 2.0], [0.0, 1.0, 1.5]]]);
    let rays = |count: usize| {
        let numbers = |x: f64| vec![x; count];
        [numbers(0.0), numbers(0.25), numbers(1.0)]
    };
    for scene in by_each_set(&scene) {
        let mut hits = HitArrays::default();
        for count in [64, 1] {
            let [x, y, z] = rays(count);
            let packet = RayPacket::from([0.0; 3], [&x, &y, &z]);
            scene.packet_closest_hits(&packet, &mut hits);
            assert_eq!(hits.get(0), scene.closest_hit(&packet.ray(0)));
        }
    }
}
