//! The packets of the kernels: packets that are hard on purpose, and the answers to their rays, to the
//! last bit those of testing every triangle.

use crate::cases::{Case, FAR, TRIANGLES, TRIANGLES_F64};
use crate::checks::scene_with;
use kdray::geometry::Common;
use kdray::primitives::HitArrays;
use kdray::{Arithmetic, BuildOptions, Hit, Interval, PacketWork, Precision, Ray, Scene};
use kdray::{ShapeScene, TriangleMesh};
use kdray_tests::bits::Bits;
use kdray_tests::rays::random;
use kdray_tests::sets::Together;
use kdray_tests::{OwnedPacket, Packer, Subject, sets};
use rand::RngExt;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use std::sync::LazyLock;

/// How many packets of each kind and size are made for each case.
const EACH: usize = 3;

/// How many times packets are made with rays in the split planes of each tree.
const IN_SPLIT_PLANES: usize = 4;

/// A packet, and the answers to its rays without a tree.
pub(crate) struct Asked {
    packet: OwnedPacket,
    naive: Vec<Option<Hit>>,
}

/// For each case of [`TRIANGLES`] its packets.
pub(crate) static PACKETS: LazyLock<Vec<Vec<Asked>>> = LazyLock::new(|| made(&TRIANGLES, EACH));

/// For each case of [`TRIANGLES_F64`] its packets.
pub(crate) static PACKETS_F64: LazyLock<Vec<Vec<Asked>>> =
    LazyLock::new(|| made(&TRIANGLES_F64, 1));

/// Packets at each case, `each` of every kind and size.
fn made<T: Precision>(cases: &[Case<TriangleMesh<T>, 3>], each: usize) -> Vec<Vec<Asked>> {
    let made = |case: &Case<TriangleMesh<T>, 3>| {
        let rays: Vec<Ray> = case.aimed.iter().map(|aimed| aimed.ray).collect();
        let packets = Packer::new(&case.subject, &rays, case.seed).all_kinds(each, FAR);
        asked(&case.subject, packets, case.seed)
    };
    cases.iter().map(made).collect()
}

/// Packets as they are, and with other intervals.
fn asked<T: Precision>(mesh: &TriangleMesh<T>, packets: Vec<OwnedPacket>, seed: u64) -> Vec<Asked> {
    let one_leaf = BuildOptions { leaf_size: usize::MAX, ..BuildOptions::default() };
    let shapes = ShapeScene::build(mesh.clone(), &one_leaf).expect("cases are valid");
    let variants = |(index, packet): (usize, OwnedPacket)| {
        let mut random = random(seed + 1000 * index as u64);
        let ts = ts_of_hits(&shapes, &packet);
        let same = packet.with_interval(one_interval(&ts, &mut random));
        let own: Vec<_> = ts.iter().map(|&t| own_interval(t, &mut random)).collect();
        [packet.with_intervals(&own), same, packet]
    };
    let naive = |packet: OwnedPacket| {
        let naive = packet.rays().iter().map(|ray| shapes.naive().closest_hit(ray)).collect();
        Asked { packet, naive }
    };
    let packets: Vec<_> = packets.into_iter().enumerate().collect();
    packets.into_par_iter().flat_map(variants).map(naive).collect()
}

/// Where the line of each ray meets a triangle: the first hit before its origin or, of others, behind.
fn ts_of_hits<T: Precision>(
    shapes: &ShapeScene<TriangleMesh<T>>,
    packet: &OwnedPacket,
) -> Vec<Option<f64>> {
    let first = |ray: &Ray| {
        let ahead = shapes.naive().closest_hit(ray);
        let line = Ray { interval: Interval::LINE, ..*ray };
        ahead.or_else(|| shapes.naive().closest_hit(&line)).map(|hit| hit.t)
    };
    packet.rays().iter().map(first).collect()
}

/// An interval for all rays, about the hit of one.
fn one_interval(ts: &[Option<f64>], random: &mut Pcg64Mcg) -> Interval {
    let t = ts.choose(random).copied().flatten();
    if random.random() { own_interval(t, random) } else { INTERVALS[random.random_range(0..10)] }
}

/// An interval that begins or ends exactly at a hit or a step before or behind, or any other.
fn own_interval(t: Option<f64>, random: &mut Pcg64Mcg) -> Interval {
    let any = INTERVALS[random.random_range(0..INTERVALS.len())];
    let Some(t) = t else { return any };
    let (t_min, t_max) = match random.random_range(0..10) {
        0 => (t, f64::INFINITY),
        1 => (t.next_up(), f64::INFINITY),
        2 => (0.0, t),
        3 => (0.0, t.next_down()),
        4 => (t, t),
        5 => (f64::NEG_INFINITY, t),
        6 => (0.5 * t, 2.0 * t),
        7 => (t.next_down(), t.next_up()),
        _ => return any,
    };
    Interval { t_min, t_max }
}

/// All t, some, and none.
const INTERVALS: [Interval; 14] = {
    const fn from(t_min: f64, t_max: f64) -> Interval {
        Interval { t_min, t_max }
    }
    [
        Interval::FORWARD,
        Interval::FORWARD,
        Interval::LINE,
        from(0.0, 1.0),
        from(0.0, 0.5),
        from(1e-9, 1.0),
        from(-1e30, 1e30),
        from(f64::NEG_INFINITY, 0.0),
        from(0.0, 0.0),
        from(0.5, 1e300),
        from(1.0, 0.0),
        from(-2.0, -1.0),
        from(f64::INFINITY, f64::INFINITY),
        from(f64::NAN, 1.0),
    ]
};

/// What is compared of a packet's answers: how many rays it answered, or what is wrong.
type Check<T> = fn(&Scene<T>, &Asked, &mut HitArrays) -> Result<Together, String>;

/// The packets of cases.
type Packets<'a, T> = (&'a [Case<TriangleMesh<T>, 3>], &'a [Vec<Asked>]);

/// Builds a tree over each case and checks the answers to its packets, and to packets in the tree's
/// split planes, by the kernels of an instruction set. How many rays packets answered; `None` if they are batches, as
/// on the portable set, and if this processor does not have the set.
fn on_each<T: Precision>(
    options: &BuildOptions,
    (cases, packets): Packets<'_, T>,
    instructions: &str,
    check: Check<T>,
) -> Option<Together> {
    let set = sets::named(instructions)?;
    let mut together = None;
    for (case, packets) in cases.iter().zip(packets) {
        let scene = scene_with(options, case, set);
        let rays: Vec<Ray> = case.aimed.iter().map(|aimed| aimed.ray).collect();
        let mut packer = Packer::new(&case.subject, &rays, case.seed + 1);
        let in_planes = packer.in_split_planes(scene.tree(), IN_SPLIT_PLANES);
        let in_planes = asked(&case.subject, in_planes, case.seed + 1);
        // What was there before must not matter.
        let mut hits = HitArrays::default();
        let (mut wrong, mut answered) = (Vec::new(), Together::default());
        for asked in packets.iter().chain(&in_planes) {
            match check(&scene, asked, &mut hits) {
                Ok(count) => answered += count,
                Err(error) => wrong.push(error),
            }
        }
        if let Some(first) = wrong.first() {
            let all = packets.len() + in_planes.len();
            panic!("case {:?}, {} of {all} packets: {first}", case.name, wrong.len());
        }
        if sets::has_packets(&scene, set) {
            *together.get_or_insert_default() += answered;
        }
    }
    together
}

/// The closest hits of all packets' rays, and of each ray alone.
pub(crate) fn closest_hits<T: Precision>(
    options: &BuildOptions,
    packets: Packets<'_, T>,
    instructions: &str,
) {
    // Those to a target are left, all: 0012.
    if let Some(together) = on_each(options, packets, instructions, closest_hit) {
        assert!(together.origin > 0 && together.direction > 0, "packets answer {together:?}");
    }
}

/// Whether all packets' rays hit anything, and each ray alone.
pub(crate) fn any_hits<T: Precision>(
    options: &BuildOptions,
    packets: Packets<'_, T>,
    instructions: &str,
) {
    if let Some(together) = on_each(options, packets, instructions, any_hit) {
        let Together { origin, direction, target } = together;
        assert!(origin > 0 && direction > 0 && target > 0, "packets answer {together:?}");
    }
}

/// Answers in float arithmetic to all packets.
pub(crate) fn in_float<T: Precision>(
    options: &BuildOptions,
    packets: Packets<'_, T>,
    instructions: &str,
) {
    if let Some(together) = on_each(options, packets, instructions, float) {
        let Together { origin, direction, target } = together;
        assert!(origin > 0 && direction > 0 && target > 0, "packets answer {together:?}");
    }
}

fn closest_hit<T: Precision>(
    scene: &Scene<T>,
    asked: &Asked,
    hits: &mut HitArrays,
) -> Result<Together, String> {
    let packet = asked.packet.packet();
    let work = scene.packet_closest_hits(&packet, hits);
    assert_eq!(hits.len(), packet.len());
    for (index, naive) in asked.naive.iter().enumerate() {
        let (ray, found) = (packet.ray(index), hits.get(index));
        same(asked, index, &found, naive)?;
        same(asked, index, &scene.closest_hit(&ray), naive)?;
    }
    Ok(Together::of(&packet, work))
}

fn any_hit<T: Precision>(
    scene: &Scene<T>,
    asked: &Asked,
    _: &mut HitArrays,
) -> Result<Together, String> {
    let packet = asked.packet.packet();
    // What was there before must not matter.
    let mut found: Vec<bool> = (0..packet.len()).map(|index| index % 2 == 0).collect();
    let work = scene.packet_any_hits(&packet, &mut found);
    for (index, (found, naive)) in found.iter().zip(&asked.naive).enumerate() {
        same(asked, index, found, &naive.is_some())?;
        same(asked, index, &scene.any_hit(&packet.ray(index)), &naive.is_some())?;
    }
    Ok(Together::of(&packet, work))
}

/// In float arithmetic what packets answer is exact. Of the rays that they leave, most of which are aimed at edges, no
/// more is known than that ids are of triangles, t within the interval or close to its ends, and nothing hit by rays
/// that cannot be; how good answers to other rays are is checked in [`crate::float`].
fn float<T: Precision>(
    scene: &Scene<T>,
    asked: &Asked,
    hits: &mut HitArrays,
) -> Result<Together, String> {
    let scene = scene.clone().with_arithmetic(Arithmetic::Float);
    let packet = asked.packet.packet();
    let mut found = vec![false; packet.len()];
    let closest = scene.packet_closest_hits(&packet, hits);
    let any = scene.packet_any_hits(&packet, &mut found);
    let (mut other_closest, mut other_any) = (Other::default(), Other::default());
    for (index, (found, naive)) in found.into_iter().zip(&asked.naive).enumerate() {
        let (ray, hit) = (packet.ray(index), hits.get(index));
        let may_hit = ray.check().is_ok() && !ray.interval.is_empty();
        let is_sane = match hit {
            Some(hit) => is_near(&scene, &ray, hit.t) && is_known(&scene, hit.primitive_id),
            None => true,
        };
        let is_right = is_sane && (may_hit || (hit.is_none() && !found));
        let told = |error| format!("{error}: {hit:?}, any: {found}");
        same(asked, index, &is_right, &true).map_err(told)?;
        other_closest.note(asked, index, &hit, naive);
        other_any.note(asked, index, &found, &naive.is_some());
    }
    other_closest.no_more_than_left::<T>(closest)?;
    other_any.no_more_than_left::<T>(any)?;
    let mut together = Together::of(&packet, closest);
    together += Together::of(&packet, any);
    Ok(together)
}

/// Answers to a packet that are not the exact ones.
#[derive(Default)]
struct Other {
    count: usize,
    first: Option<String>,
}

impl Other {
    fn note<A: Bits + std::fmt::Debug>(&mut self, asked: &Asked, index: usize, a: &A, exact: &A) {
        if !a.is_same(exact) {
            self.count += 1;
            self.first = self.first.take().or_else(|| same(asked, index, a, exact).err());
        }
    }

    /// Whether they are so few that all of them may be to rays which the packet left; at f64 vertices these are
    /// exact as well.
    fn no_more_than_left<T: Precision>(self, work: PacketWork) -> Result<(), String> {
        let most = if T::FITS_TREE { work.left } else { 0 };
        match self.first {
            Some(first) if self.count > most => {
                Err(format!("{} rays were left, {} are not exact: {first}", work.left, self.count))
            }
            _ => Ok(()),
        }
    }
}

fn is_known<T: Precision>(scene: &Scene<T>, id: u32) -> bool {
    (id as usize) < scene.mesh().triangles().len()
}

/// Whether t is in the interval, or as far outside of it as f32 rounds it: by some digits of where it is, and of how
/// long the ray takes to pass the mesh.
fn is_near<T: Precision>(scene: &Scene<T>, ray: &Ray, t: f64) -> bool {
    let Interval { t_min, t_max } = ray.interval;
    let (min, max) = scene.mesh().extent();
    let largest = min.into_iter().chain(max).fold(0.0, |most: f64, x| most.max(x.abs()));
    let speed = ray.direction.into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let slack = 1e-5 * (t.abs() + 4.0 * largest / speed);
    t_min - slack <= t && t <= t_max + slack
}

fn same<T: Bits + std::fmt::Debug>(
    asked: &Asked,
    index: usize,
    found: &T,
    naive: &T,
) -> Result<(), String> {
    if found.is_same(naive) {
        return Ok(());
    }
    let packet = asked.packet.packet();
    let kind = match packet.common() {
        Common::Origin(_) => "origin",
        Common::Direction(_) => "direction",
        Common::Target(_) => "target",
    };
    let (count, ray) = (packet.len(), packet.ray(index));
    Err(format!(
        "common {kind}, ray {index} of {count}, {ray:?}: found {found:?}, without a tree {naive:?}"
    ))
}
