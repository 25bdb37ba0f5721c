//! Tree files, of which every checksum is made right, so that what comes behind it is reached.

use super::draw::Draw;
use super::instructions;
use crate::OwnedPacket;
use kdray::file::{HEADER_BYTES, file_bytes};
use kdray::geometry::Common;
use kdray::memory::{AlignedBytes, SharedBytes};
use kdray::primitives::{HitArrays, HitRule};
use kdray::{Arithmetic, Hint, Hit, InstructionSet, Precision, Ray, Scene, Side};
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

/// How many nodes the wide tree has in an input that begins with a whole file of that precision, which is loaded once
/// its checksums are right; `None` if it does not.
pub fn wide_nodes<T: Precision>(input: &[u8]) -> Option<u64> {
    // Where the header says how many homes there are: there is one of each node.
    const HOMES: usize = 24 + 5 * 8;
    let mut sealed = input.to_vec();
    seal(&mut sealed);
    let length = usize::try_from(file_bytes(&sealed).ok()?).ok()?;
    let file = sealed.get_mut(..length)?;
    seal(file);
    Scene::<T>::load(shared(file)).ok()?;
    let count = file.get(HOMES..)?.first_chunk()?;
    Some(u64::from_le_bytes(*count))
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
    let mut rays = Vec::new();
    for _ in 0..8 {
        let ray = draw.ray(opened.mesh());
        ask(&opened, &ray);
        rays.push(ray);
        if !draw.has_more() {
            break;
        }
    }
    ask_batches(&opened, &rays);
    if let Ok(loaded) = &loaded {
        check(loaded, &rays);
    }
    ask_packets(&opened);
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
    let _ = (scene.count(ray), scene.shapes().count(ray));
    if let Some((hit, hint)) = scene.closest_hit_with_hint(ray) {
        let _ = scene.any_hit_near(ray, hint);
        let _ = scene.thickness(hit.primitive_id, hit.u, hit.v, Side::Front);
    }
    ask_about_points(scene, ray);
}

/// Several rays at once, with hints of each other, and points at once.
fn ask_batches<T: Precision>(scene: &Scene<T>, rays: &[Ray]) {
    let many = together(rays, 9);
    let mut found = vec![false; many.len()];
    let hint = |ray: &Ray| scene.closest_hit_with_hint(ray).map_or(Hint::NONE, |(_, hint)| hint);
    let mut hints: Vec<_> = many.iter().map(hint).collect();
    hints.rotate_left(1);
    let float = scene.clone().with_arithmetic(Arithmetic::Float);
    for scene in [scene, &float] {
        scene.any_hits(&many, &mut found);
        scene.any_hits_near(&many, &hints, &mut found);
        scene.counts(&many, &mut vec![0; many.len()]);
        scene.each_all_hits(&many, |_, hits| {
            hits.iter().for_each(|hit| assert_known(scene, Some(*hit)));
        });
    }
    let points: Vec<_> = together(rays, 64).iter().map(|ray| ray.origin).collect();
    scene.contains_each(&points, &mut vec![false; points.len()]);
}

/// The same rays, again and again until there are so many: few are not taken together.
fn together(rays: &[Ray], least: usize) -> Vec<Ray> {
    rays.iter().copied().cycle().take(rays.len().max(least)).collect()
}

fn ask_about_points<T: Precision>(scene: &Scene<T>, ray: &Ray) {
    let end = ray.at(1.0);
    for point in [ray.origin, end] {
        let _ = (scene.contains(point), scene.signed_distance(point), scene.winding_number(point));
        let _ = scene.closest_point(point);
    }
    let _ = scene.visible(ray.origin, end);
}

/// Packets of each kind, at the root's box: from before it, along a direction, and towards its middle.
fn ask_packets<T: Precision>(scene: &Scene<T>) {
    let bounds = scene.tree().bounds();
    let at = |axis: usize, share: f64| {
        let [min, max] = [bounds.min[axis], bounds.max[axis]].map(f64::from);
        min + share * (max - min)
    };
    let point = |i: usize| [at(0, (i % 8) as f64 / 8.0), at(1, i as f64 / 64.0), at(2, -1.0)];
    let before: Vec<_> = (0..64).map(point).collect();
    let ways: Vec<_> =
        (0..64).map(|i| [(i % 8) as f64 - 3.5, (i / 8) as f64 - 3.5, 16.0]).collect();
    let middle = [0, 1, 2].map(|axis| at(axis, 0.5));
    ask_packet(scene, &OwnedPacket::new(Common::Origin(before[28]), &ways));
    ask_packet(scene, &OwnedPacket::new(Common::Direction([0.01, 0.0, 1.0]), &before));
    ask_packet(scene, &OwnedPacket::new(Common::Target(middle), &before));
}

fn ask_packet<T: Precision>(scene: &Scene<T>, owned: &OwnedPacket) {
    let packet = owned.packet();
    let (mut hits, mut found) = (HitArrays::default(), vec![false; packet.len()]);
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
fn check<T: Precision>(scene: &Scene<T>, rays: &[Ray]) {
    let naive = scene.shapes().naive();
    for ray in rays {
        assert_eq!(scene.shapes().closest_hit(ray), naive.closest_hit(ray), "leaf walk, {ray:?}");
        assert_eq!(scene.closest_hit(ray), naive.closest_hit(ray), "{ray:?}");
        assert_eq!(scene.any_hit(ray), naive.any_hit(ray), "{ray:?}");
        let crossed = naive.all_hits(ray, HitRule::Crossing);
        let mut all = Vec::new();
        scene.all_hits_into(ray, &mut all);
        assert_eq!(all, crossed, "{ray:?}");
        assert_eq!(scene.count(ray), crossed.len(), "{ray:?}");
    }
    let many = together(rays, 9);
    let (mut hits, mut found) = (vec![None; many.len()], vec![false; many.len()]);
    scene.closest_hits(&many, &mut hits);
    scene.any_hits(&many, &mut found);
    for (ray, (hit, found)) in many.iter().zip(hits.into_iter().zip(found)) {
        let expected = naive.closest_hit(ray);
        assert_eq!((hit, found), (expected, expected.is_some()), "{ray:?}");
    }
    scene.each_all_hits(&many, |place, hits| {
        assert_eq!(hits, naive.all_hits(&many[place], HitRule::Crossing), "{:?}", many[place]);
    });
}
