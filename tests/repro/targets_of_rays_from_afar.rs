//! Rays to a target pass it, because their directions are rounded, at up to 2^-53 of their length on each axis. From
//! very far away that is more than the margins of the bounding frustum, which then left out what the rays hit.

use kdray::{BuildOptions, InstructionSet, RayPacket, Scene};
use kdray_tests::meshes;

/// All rays go along the diagonal, past the target but through the triangle.
#[test]
fn what_rays_hit_that_pass_their_target_is_found() {
    let (z, x) = (1e-3_f32, (1e-3 + 2e-6) as f32);
    let triangle = [[x, 0.5 * z, z], [x, 1.5 * z, z], [x - z, z, z]];
    let scene = Scene::build(meshes::mesh(vec![triangle]), &BuildOptions::default());
    let scene = scene.expect("one triangle is no trouble");
    let origins = vec![1e11; 64];
    let packet = RayPacket::towards([4e-6, 0.0, 0.0], [&origins, &origins, &origins]);
    assert!(scene.any_hit(&packet.ray(0)), "{:?}", packet.ray(0));
    for set in InstructionSet::available() {
        let mut found = [false; 64];
        scene.clone().with_instructions(set).packet_any_hits(&packet, &mut found);
        assert_eq!(found, [true; 64], "{set}");
    }
}
