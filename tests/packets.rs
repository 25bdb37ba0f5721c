//! Packets on real scenes give the answers of single rays, to the last bit: camera rays, which share
//! their origin; from what they hit, shadow rays to the scene's light, and rays to the sun.
//!
//! Some small scenes are looked at, or all that have a camera with the environment variable `KDRAY_FULL`
//! set.

use kdray::geometry::{Common, tile_order};
use kdray::primitives::HitArrays;
use kdray::{BuildOptions, Preset, Ray, Scene};
use kdray_tests::OwnedPacket;
use kdray_tests::agree::view;
use kdray_tests::bits::Bits;
use kdray_tests::sets::{Together, count_with_vectors};
use kdray_tests::shared::{CameraInfo, SceneInfo, load_mesh, scenes};

/// Small scenes that are hard in different ways.
const SCENES: [&str; 7] = [
    "cornell_box",
    "teapot",
    "suzanne",
    "lego_car",
    "awkward_axis_aligned",
    "awkward_degenerate",
    "awkward_nonmanifold",
];

/// Pixels across and down; not a multiple of a tile's, so that packets are not whole.
const SIZE: usize = 120;

/// Where the sun is; no component is zero, or like another.
const SUN: [f64; 3] = [0.41, 0.73, -0.29];

/// The scenes that are looked at, all of [`SCENES`] among them; `None` if there are none at all.
fn chosen() -> Option<Vec<(SceneInfo, CameraInfo)>> {
    let is_full = std::env::var_os("KDRAY_FULL").is_some();
    let seen = |info: SceneInfo| {
        let camera = info.camera.filter(|_| is_full || is_small(&info))?;
        Some((info, camera))
    };
    let chosen: Vec<_> = scenes()?.into_iter().filter_map(seen).collect();
    let small = chosen.iter().filter(|(info, _)| is_small(info)).count();
    assert_eq!(small, SCENES.len(), "scenes have other names, or no cameras");
    Some(chosen)
}

fn is_small(info: &SceneInfo) -> bool {
    SCENES.contains(&info.name.as_str())
}

/// The camera's rays, neighbours together.
fn camera_rays(camera: &CameraInfo) -> (OwnedPacket, Vec<Ray>) {
    let by_rows = view(camera, SIZE);
    let place = |[x, y]: [u32; 2]| y as usize * SIZE + x as usize;
    let rays: Vec<Ray> =
        tile_order(SIZE as u32, SIZE as u32).map(|pixel| by_rows[place(pixel)]).collect();
    let directions: Vec<_> = rays.iter().map(|ray| ray.direction).collect();
    (OwnedPacket::new(Common::Origin(camera.eye), &directions), rays)
}

/// Compares all answers to a packet with those to its rays alone; how many hit. Adds those that packets answered.
fn count_same(scene: &Scene, name: &str, packet: &OwnedPacket, together: &mut Together) -> usize {
    let packet = packet.packet();
    let (mut hits, mut found) = (HitArrays::default(), vec![false; packet.len()]);
    *together += Together::of(&packet, scene.packet_closest_hits(&packet, &mut hits));
    *together += Together::of(&packet, scene.packet_any_hits(&packet, &mut found));
    for (index, found) in found.iter().enumerate() {
        let ray = packet.ray(index);
        let alone = scene.closest_hit(&ray);
        let hit = hits.get(index);
        assert!(hit.is_same(&alone), "{name}, ray {index}: {ray:?}: {hit:?}, alone {alone:?}");
        assert_eq!(*found, alone.is_some(), "{name}, any hit of ray {index}: {ray:?}");
    }
    found.into_iter().filter(|&is_hit| is_hit).count()
}

/// Compares the answers to all packets in a scene; how many rays packets answered.
fn look_at(scene: &Scene, info: &SceneInfo, camera: &CameraInfo, preset: Preset) -> Together {
    let mut together = Together::default();
    let told = |what| format!("{what} of {} with {preset:?}", info.name);
    let (packet, rays) = camera_rays(camera);
    let seen = count_same(scene, &told("camera rays"), &packet, &mut together);
    assert!(seen > 100 || !is_small(info), "{} is hardly hit", info.name);
    let points = rays.iter().filter_map(|ray| Some(ray.at(scene.closest_hit(ray)?.t)));
    let points: Vec<_> = points.collect();
    let to_the_sun = OwnedPacket::new(Common::Direction(SUN), &points);
    count_same(scene, &told("rays to the sun"), &to_the_sun, &mut together);
    if let Some(light) = info.point_light {
        let to_the_light = OwnedPacket::new(Common::Target(light), &points);
        count_same(scene, &told("shadow rays"), &to_the_light, &mut together);
    }
    together
}

#[test]
fn packets_see_what_single_rays_see() {
    let Some(chosen) = chosen() else { return };
    let mut together = Together::default();
    for (info, camera) in chosen {
        let mesh = load_mesh(&info).expect("the scene loads");
        for preset in Preset::ALL {
            let scene = Scene::build(mesh.clone(), &BuildOptions::preset(preset));
            let scene = scene.expect("the scene is valid");
            together += look_at(&scene, &info, &camera, preset);
        }
    }
    println!("packets answered {together:?}");
    // Packets are batches where there are no vectors.
    if count_with_vectors() > 0 {
        let Together { origin, direction, target } = together;
        assert!(origin > 0 && direction > 0 && target > 0, "packets answer {together:?}");
    }
}
