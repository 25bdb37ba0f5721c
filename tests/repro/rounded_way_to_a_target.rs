//! The direction of a ray to a target is rounded, so that it goes past the target by as much as the
//! coordinates of its origin are rounded. The lines of small triangles near the target are far more
//! exact than that, and the filter took the ray for one through the target. Packets still answer such
//! rays in a large scene; those from far away they leave since (see `targets_of_rays_from_afar`).

use kdray::{BuildOptions, RayPacket, Scene};
use kdray_tests::meshes;
use kdray_tests::sets::{by_each_set, count_with_vectors};

/// All rays go past the target, through zero, along the diagonal; the triangle is `before` the target, and
/// begins between their way and the one to the target. How many of them packets answered.
fn assert_missed(target: f64, before: f64, origin: f64, others: &[[[f32; 3]; 3]]) -> usize {
    let (x, z) = ((0.5 * target + before) as f32, before as f32);
    let triangle = [[x, 0.5 * z, z], [x, 1.5 * z, z], [x + z, z, z]];
    let mesh = meshes::mesh([&[triangle], others].concat());
    let scene = Scene::build(mesh, &BuildOptions::default()).expect("the mesh is small");
    let origins = vec![origin; 64];
    let packet = RayPacket::towards([target, 0.0, 0.0], [&origins, &origins, &origins]);
    assert!(!scene.any_hit(&packet.ray(0)), "{:?}", packet.ray(0));
    let mut answered = 0;
    for scene in by_each_set(&scene) {
        let mut found = [false; 64];
        answered += 64 - scene.packet_any_hits(&packet, &mut found).left;
        assert_eq!(found, [false; 64]);
    }
    answered
}

#[test]
fn a_triangle_near_the_target_of_rays_from_afar_is_missed() {
    assert_eq!(assert_missed(4e-6, 1e-3, 1e11, &[]), 0, "not left");
}

#[test]
fn a_tiny_triangle_near_the_target_in_a_large_scene_is_missed() {
    let large = [[-1e6, 0.0, -1e6], [-1e6, 1e6, -1e6], [-1e6, 0.0, -5e5]];
    let answered = assert_missed(4e-11, 1e-8, 7.5e5, &[large]);
    assert_eq!(answered, 64 * count_with_vectors());
}
