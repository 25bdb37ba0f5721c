//! A hit where the rays of a packet begin, in the plane of zero, was infinitely near, which is how rays
//! are marked that take no part: of other triangles there, those of smaller ids were not considered.

use kdray::primitives::HitArrays;
use kdray::{BuildOptions, CostModel, RayPacket, Scene, Strategy};
use kdray_tests::meshes;
use kdray_tests::sets::by_each_set;

#[test]
fn of_triangles_that_meet_at_the_origin_the_smallest_id_wins() {
    let cost = CostModel { block: 8, ..CostModel::default() };
    let options = BuildOptions { leaf_size: 1, cost, ..BuildOptions::for_strategy(Strategy::Sah) };
    let scene = Scene::build(meshes::mesh(meshes::boxes(3)), &options).unwrap();
    let corners = (0..=6).flat_map(|x| (0..=6).map(move |y| [x, y, 0]));
    for origin in corners.map(|p| p.map(|x| 0.5 * f64::from(x))) {
        for signs in 0..8 {
            let sign = |axis: u32| if signs >> axis & 1 == 1 { -1.0 } else { 1.0 };
            let (x, y, z) = (vec![sign(0); 64], vec![sign(1); 64], vec![2.0 * sign(2); 64]);
            let packet = RayPacket::from(origin, [&x, &y, &z]);
            let ray = packet.ray(0);
            for scene in by_each_set(&scene) {
                let mut hits = HitArrays::default();
                scene.packet_closest_hits(&packet, &mut hits);
                assert_eq!(hits.get(0), scene.closest_hit(&ray), "{ray:?}");
            }
        }
    }
}
