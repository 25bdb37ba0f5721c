//! Plain floating point: how good its answers are to rays that are not aimed at edges. At f64 vertices they are exact.

use crate::cases::{Case, TRIANGLES};
use crate::checks::scene_with;
use kdray::primitives::HitArrays;
use kdray::{Arithmetic, BuildOptions, Hint, Hit, InstructionSet, Precision, Ray, Scene};
use kdray::{Side, TriangleMesh};
use kdray_tests::bits::Bits;
use kdray_tests::{OwnedPacket, Packer, sets};

/// How many packets of each kind are made, and of how many rays.
const PACKETS: usize = 4;
const RAYS: usize = 128;

/// All answers to some rays, by what was asked.
struct Answers {
    closest: [(&'static str, Vec<Option<Hit>>); 4],
    any: [(&'static str, Vec<bool>); 5],
}

impl Answers {
    /// To rays alone, in a batch, with hints, and in the packets that they came in.
    fn of<T: Precision>(scene: &Scene<T>, rays: &[Ray], packets: &[OwnedPacket]) -> Self {
        let mut batch = vec![None; rays.len()];
        let [mut any_batch, mut near_batch] = [(); 2].map(|()| vec![false; rays.len()]);
        let hinted: Vec<_> = rays.iter().map(|ray| scene.closest_hit_with_hint(ray)).collect();
        let hints: Vec<Hint> =
            hinted.iter().map(|it| it.map(|it| it.1).unwrap_or_default()).collect();
        let near = rays.iter().zip(&hints).map(|(ray, &hint)| scene.any_hit_near(ray, hint));
        scene.closest_hits(rays, &mut batch);
        scene.any_hits(rays, &mut any_batch);
        scene.any_hits_near(rays, &hints, &mut near_batch);
        let (packets, any_packets) = in_packets(scene, packets);
        Self {
            any: [
                ("any hit", rays.iter().map(|ray| scene.any_hit(ray)).collect()),
                ("any hit near", near.collect()),
                ("any hit in a batch", any_batch),
                ("any hit near in a batch", near_batch),
                ("any hit in packets", any_packets),
            ],
            closest: [
                ("closest hit", rays.iter().map(|ray| scene.closest_hit(ray)).collect()),
                ("closest hit with hint", hinted.into_iter().map(|it| Some(it?.0)).collect()),
                ("closest hit in a batch", batch),
                ("closest hit in packets", packets),
            ],
        }
    }
}

fn in_packets<T: Precision>(
    scene: &Scene<T>,
    packets: &[OwnedPacket],
) -> (Vec<Option<Hit>>, Vec<bool>) {
    let (mut hits, mut any) = (HitArrays::default(), Vec::new());
    let mut closest = Vec::new();
    for packet in packets.iter().map(OwnedPacket::packet) {
        let mut found = vec![false; packet.len()];
        scene.packet_closest_hits(&packet, &mut hits);
        scene.packet_any_hits(&packet, &mut found);
        closest.extend((0..packet.len()).map(|index| hits.get(index)));
        any.extend(found);
    }
    (closest, any)
}

/// What is promised of answers.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Promise {
    /// All bits: at f64 vertices.
    Exact,
    /// Five digits.
    Digits,
    /// Where coordinates are far larger than triangles, so that f32 has few digits for these: which triangle it is.
    Triangle,
}

impl Promise {
    fn of<T: Precision>(case: &Case<TriangleMesh<T>, 3>) -> Self {
        match case.name {
            _ if !T::FITS_TREE => Self::Exact,
            "far soup" => Self::Triangle,
            _ => Self::Digits,
        }
    }

    /// How many rays may be answered otherwise if so many hit: rays slip through edges, some come near them by chance,
    /// and where a ray begins at a triangle, or meets it at a flat angle, digits are lost.
    fn most_wrong(self, hits: usize) -> usize {
        match self {
            Self::Exact => 0,
            Self::Digits => hits / 50,
            Self::Triangle => hits / 8,
        }
    }

    fn is_kept(self, found: Option<Hit>, exact: Option<Hit>) -> bool {
        match (found, exact) {
            _ if self == Self::Exact => found.is_same(&exact),
            (Some(found), Some(exact)) if self == Self::Digits => is_close(&found, &exact),
            (Some(found), Some(exact)) => {
                found.primitive_id == exact.primitive_id && found.side == exact.side
            }
            (None, None) => true,
            _ => false,
        }
    }

    /// How many answers do not keep it.
    fn count_broken(self, found: &[Option<Hit>], exact: &[Option<Hit>]) -> usize {
        found.iter().zip(exact).filter(|&(&found, &exact)| !self.is_kept(found, exact)).count()
    }
}

/// Whether all that a hit says is right by five digits; another triangle that is as near will do.
fn is_close(found: &Hit, exact: &Hit) -> bool {
    const DIGITS: f64 = 1e-5;
    let is_other = found.primitive_id != exact.primitive_id;
    let off = (found.u - exact.u).abs().max((found.v - exact.v).abs());
    let is_there = off <= DIGITS && found.side == exact.side;
    (found.t - exact.t).abs() <= DIGITS * exact.t.abs() && (is_other || is_there)
}

/// Rays through any points, in packets and one after the other.
fn at_random<T: Precision>(case: &Case<TriangleMesh<T>, 3>) -> (Vec<OwnedPacket>, Vec<Ray>) {
    let mut packer = Packer::new(&case.subject, &[], case.seed + 2);
    let packets: Vec<_> = (0..PACKETS).flat_map(|_| packer.at_random(RAYS)).collect();
    let rays = packets.iter().flat_map(OwnedPacket::rays).collect();
    (packets, rays)
}

/// Builds a tree over each case, and compares all answers in float arithmetic to random rays with the exact ones.
pub(crate) fn is_close_to_exact<T: Precision>(
    options: &BuildOptions,
    cases: &[Case<TriangleMesh<T>, 3>],
    instructions: &str,
) {
    let Some(set) = sets::named(instructions) else { return };
    // Some cases have nothing that a ray might hit.
    let mut all_hits = 0;
    for case in cases.iter().filter(|case| !case.subject.triangles().is_empty()) {
        let exact = scene_with(options, case, set);
        let (packets, rays) = at_random(case);
        let hits: Vec<_> = rays.iter().map(|ray| exact.closest_hit(ray)).collect();
        all_hits += hits.iter().flatten().count();
        let float = exact.with_arithmetic(Arithmetic::Float);
        assert_promised(case, &hits, &Answers::of(&float, &rays, &packets));
    }
    assert!(all_hits > 500, "{all_hits} hits");
}

fn assert_promised<T: Precision>(
    case: &Case<TriangleMesh<T>, 3>,
    exact: &[Option<Hit>],
    answers: &Answers,
) {
    let promise = Promise::of(case);
    let hits = exact.iter().flatten().count();
    let most = promise.most_wrong(hits);
    let told = |name, wrong| format!("case {:?}, {name}: {wrong} wrong, {hits} hits", case.name);
    for (name, found) in &answers.closest {
        let wrong = promise.count_broken(found, exact);
        assert!(wrong <= most, "{}", told(name, wrong));
    }
    for (name, found) in &answers.any {
        let wrong = found.iter().zip(exact).filter(|(found, hit)| **found != hit.is_some()).count();
        assert!(wrong <= most, "{}", told(name, wrong));
    }
}

/// What a kernel might get wrong is more than may be.
#[test]
fn what_is_wrong_is_noticed() {
    let case = &TRIANGLES[0];
    let scene = scene_with(&BuildOptions::default(), case, InstructionSet::PORTABLE);
    let (_, rays) = at_random(case);
    let exact: Vec<_> = rays.iter().map(|ray| scene.closest_hit(ray)).collect();
    let most = Promise::Digits.most_wrong(exact.iter().flatten().count());
    let wrong = |found: &[Option<Hit>]| Promise::Digits.count_broken(found, &exact);
    let spoilt = |spoil: fn(Hit) -> Option<Hit>| -> Vec<_> {
        exact.iter().map(|hit| hit.and_then(spoil)).collect()
    };
    assert_eq!(wrong(&exact), 0);
    let farthest: Vec<_> = rays.iter().map(|ray| scene.all_touched(ray).last()).collect();
    assert!(wrong(&farthest) > most);
    assert!(wrong(&spoilt(|hit| Some(Hit { u: hit.v, v: hit.u, ..hit }))) > most);
    assert!(wrong(&spoilt(|hit| Some(Hit { t: hit.t * (1.0 + 2e-5), ..hit }))) > most);
    let turned = |hit: Hit| match hit.side {
        Side::Front => Hit { side: Side::Back, ..hit },
        Side::Back => Hit { side: Side::Front, ..hit },
    };
    assert!(exact.iter().flatten().all(|&hit| !is_close(&turned(hit), &hit)));
    assert!(wrong(&spoilt(|_| None)) > most);
}
