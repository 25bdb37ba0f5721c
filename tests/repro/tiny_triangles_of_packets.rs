//! Parallel packets: the forms of triangles smaller than some 2^-131 lost digits to underflow, which far origins multiplied: a
//! triangle was surely missed by a ray through its inside.

use kdray::{BuildOptions, RayPacket, Scene};
use kdray_tests::meshes;
use kdray_tests::sets::assert_packet_agrees;

#[test]
fn triangles_of_few_units_are_hit_beside_far_rays() {
    for exponent in [149, 145, 137, 129] {
        let unit = 2.0_f64.powi(-exponent);
        let tiny = [[-3.0, 3.0, 3.0], [-7.0, -6.0, 4.0], [6.0, 3.0, 8.0]];
        let tiny = tiny.map(|p| p.map(|x: f64| (x * unit) as f32));
        let w = 262_144.0;
        let soup = vec![tiny, [[w, w, w], [w, 0.0, w], [0.0, w, w]]];
        let scene = Scene::build(meshes::mesh(soup), &BuildOptions::default()).unwrap();
        for far in [36, 38, 39, 40] {
            let far = -(2.0_f64.powi(far));
            let column = |first: f64, rest: f64| -> Vec<f64> {
                std::iter::once(first).chain(std::iter::repeat_n(rest, 63)).collect()
            };
            let (x, y, z) = (column(-0.3, far), column(-0.2, far), column(-1.0, -1.0));
            let packet = RayPacket::along([0.3, 0.2, 1.0], [&x, &y, &z]);
            assert!(scene.shapes().any_hit(&packet.ray(0)), "2^-{exponent}");
            assert_packet_agrees(&scene, &packet);
        }
    }
}
