//! Tree files, of which every checksum is made right, so that what comes behind it is reached.

use super::draw::Draw;
use super::instructions;
use kdray::file::{HEADER_BYTES, file_bytes};
use kdray::geometry::RayPacket;
use kdray::memory::{AlignedBytes, SharedBytes};
use kdray::primitives::{HitArrays, HitRule};
use kdray::{Arithmetic, Hit, InstructionSet, Precision, Ray, Scene, Side};
use std::sync::Arc;
use twox_hash::XxHash3_64;

/// A file of either precision, and behind it what rays to ask about are drawn from.
pub fn run(data: &[u8]) {
    open::<f32>(data);
    open::<f64>(data);
    let mut sealed = data.to_vec();
    seal(&mut sealed);
    if let Ok(length) = file_bytes(&sealed)
        && let Ok(length) = usize::try_from(length)
        && length <= sealed.len()
    {
        let rest = sealed.split_off(length);
        seal(&mut sealed);
        let set = instructions(data);
        open_and_ask::<f32>(&sealed, &rest, set);
        open_and_ask::<f64>(&sealed, &rest, set);
    } else {
        open::<f32>(&sealed);
        open::<f64>(&sealed);
    }
}

/// Makes the checksums of a file right.
pub fn seal(file: &mut [u8]) {
    if file.len() < HEADER_BYTES {
        return;
    }
    let body = XxHash3_64::oneshot(&file[HEADER_BYTES..]);
    file[16..24].copy_from_slice(&body.to_le_bytes());
    let header = XxHash3_64::oneshot(&file[..HEADER_BYTES - 8]);
    file[HEADER_BYTES - 8..HEADER_BYTES].copy_from_slice(&header.to_le_bytes());
}

fn shared(file: &[u8]) -> SharedBytes {
    Arc::new(AlignedBytes::from(file))
}

fn open<T: Precision>(file: &[u8]) {
    if Scene::<T>::open(shared(file)).is_err() {
        assert!(Scene::<T>::load(shared(file)).is_err(), "what cannot be opened is not loaded");
    }
}

fn open_and_ask<T: Precision>(file: &[u8], rest: &[u8], set: InstructionSet) {
    let opened = Scene::<T>::open(shared(file));
    let loaded = Scene::<T>::load(shared(file)).map(|scene| scene.with_instructions(set));
    let Ok(opened) = opened else {
        assert!(loaded.is_err(), "what cannot be opened is not loaded");
        return;
    };
    assert_eq!(opened.verify().err(), loaded.as_ref().err().copied());
    let opened = opened.with_instructions(set);
    let mut draw = Draw::new(rest);
    for _ in 0..8 {
        let ray = draw.ray(opened.mesh());
        ask(&opened, &ray);
        if let Ok(loaded) = &loaded {
            check(loaded, &ray);
        }
        if !draw.has_more() {
            break;
        }
    }
    ask_packet(&opened);
}

/// Asks for everything; whatever the answer is, it names triangles that are there.
fn ask<T: Precision>(scene: &Scene<T>, ray: &Ray) {
    let float = scene.clone().with_arithmetic(Arithmetic::Float);
    for scene in [scene, &float] {
        let _ = scene.any_hit(ray);
        assert_known(scene, scene.closest_hit(ray));
        let mut hits = [None; 9];
        scene.closest_hits(&[*ray; 9], &mut hits);
        hits.into_iter().for_each(|hit| assert_known(scene, hit));
    }
    assert_known(scene, scene.shapes().closest_hit(ray));
    for hit in scene.all_hits(ray).chain(scene.all_touched(ray)).take(1000) {
        assert_known(scene, Some(hit));
    }
    let mut all = Vec::new();
    scene.all_hits_into(ray, &mut all);
    all.into_iter().for_each(|hit| assert_known(scene, Some(hit)));
    if let Some((hit, hint)) = scene.closest_hit_with_hint(ray) {
        let _ = scene.any_hit_near(ray, hint);
        let _ = scene.thickness(hit.primitive_id, hit.u, hit.v, Side::Front);
    }
    ask_about_points(scene, ray);
}

fn ask_about_points<T: Precision>(scene: &Scene<T>, ray: &Ray) {
    let end = ray.at(1.0);
    for point in [ray.origin, end] {
        let _ = (scene.contains(point), scene.signed_distance(point), scene.winding_number(point));
        let _ = scene.closest_point(point);
    }
    let _ = scene.visible(ray.origin, end);
}

fn ask_packet<T: Precision>(scene: &Scene<T>) {
    let bounds = scene.tree().bounds();
    let at = |axis: usize, share: f64| {
        let [min, max] = [bounds.min[axis], bounds.max[axis]].map(f64::from);
        min + share * (max - min)
    };
    let row = |axis: usize| -> Vec<f64> {
        let share = |i: usize| if axis == 0 { (i % 8) as f64 / 8.0 } else { i as f64 / 64.0 };
        (0..64).map(|i| at(axis, share(i))).collect()
    };
    let [x, y, z] = [row(0), row(1), vec![at(2, -1.0); 64]];
    let packet = RayPacket::along([0.01, 0.0, 1.0], [&x, &y, &z]);
    let (mut hits, mut found) = (HitArrays::default(), [false; 64]);
    scene.packet_closest_hits(&packet, &mut hits);
    scene.packet_any_hits(&packet, &mut found);
    (0..packet.len()).for_each(|index| assert_known(scene, hits.get(index)));
}

fn assert_known<T: Precision>(scene: &Scene<T>, hit: Option<Hit>) {
    if let Some(hit) = hit {
        assert!((hit.primitive_id as usize) < scene.mesh().triangles().len(), "{hit:?}");
    }
}

/// What was verified gives the hits of its mesh.
fn check<T: Precision>(scene: &Scene<T>, ray: &Ray) {
    let naive = scene.shapes().naive();
    assert_eq!(scene.shapes().closest_hit(ray), naive.closest_hit(ray), "leaf walk, {ray:?}");
    assert_eq!(scene.closest_hit(ray), naive.closest_hit(ray), "{ray:?}");
    assert_eq!(scene.any_hit(ray), naive.any_hit(ray), "{ray:?}");
    let crossed = naive.all_hits(ray, HitRule::Crossing);
    let mut all = Vec::new();
    scene.all_hits_into(ray, &mut all);
    assert_eq!(all, crossed, "{ray:?}");
}
