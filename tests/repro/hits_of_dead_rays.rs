//! A ray that takes no part in its packet was a point all the same, often one that is its mirror image:
//! what that surely hits was noted for it. Where the packet was given up, that was its answer.

use kdray::{RayPacket, Scene};
use kdray_tests::meshes;
use kdray_tests::sets::by_each_set;

/// Looks at a grid past its sides, from far below: two rays that miss it, so that the frustum has all of
/// it and is given up, and another one.
fn found(towards: bool, [x, y, z]: [f64; 3]) -> [bool; 3] {
    let scene = Scene::build(meshes::mesh(meshes::grid(6, 3)), &Default::default())
        .expect("the mesh is small");
    let eye = [3.0, 3.0, -3.0];
    let from_eye = [[-30.0, -20.0, 9.0], [30.0, 20.0, 9.0], [x, y, z]];
    let offset = |axis: usize| if towards { eye[axis] } else { 0.0 };
    let [x, y, z] = [0, 1, 2].map(|axis| from_eye.map(|d| d[axis] + offset(axis)));
    let each = [&x[..], &y[..], &z[..]];
    let packet = if towards { RayPacket::towards(eye, each) } else { RayPacket::from(eye, each) };
    let mut found = [false; 3];
    for scene in by_each_set(&scene) {
        scene.packet_any_hits(&packet, &mut found);
        for (index, found) in found.iter().enumerate() {
            assert_eq!(*found, scene.any_hit(&packet.ray(index)), "{:?}", packet.ray(index));
        }
    }
    found
}

#[test]
fn a_ray_that_goes_backward_does_not_hit_what_its_mirror_image_does() {
    for (x, y) in (-5..=5).flat_map(|x| (-5..=5).map(move |y| (f64::from(x), f64::from(y)))) {
        assert_eq!(found(false, [0.051 * x, 0.052 * y, -0.3]), [false; 3]);
    }
}

#[test]
fn a_ray_from_infinity_hits_nothing() {
    let places =
        (-5..=5).flat_map(|x| (-5..=5).map(move |y| [0.5 * f64::from(x), 0.5 * f64::from(y)]));
    for ([x, y], axis) in places.flat_map(|place| (0..3).map(move |axis| (place, axis))) {
        for (sign, towards) in [(1.0, true), (-1.0, true), (1.0, false), (-1.0, false)] {
            let mut from_eye = [x, y, 3.0];
            from_eye[axis] = sign * f64::INFINITY;
            assert_eq!(found(towards, from_eye), [false; 3]);
        }
    }
}
