//! Instruction sets.

use kdray::geometry::Common;
use kdray::primitives::HitArrays;
use kdray::{InstructionSet, PacketWork, Precision, RayPacket, Scene};
use std::collections::BTreeSet;
use std::io::{self, Write};
use std::ops::AddAssign;
use std::sync::{Mutex, PoisonError};

/// The set of a name. `None` if this processor does not have it: then this says so, once. It is no failure, not even
/// with the environment variable `CI`, for processors differ.
pub fn named(name: &str) -> Option<InstructionSet> {
    let found = InstructionSet::of_name(name);
    found.inspect_err(|unknown| say_once(&format!("skipped: tests of {name}: {unknown}"))).ok()
}

/// Says it where it is seen: what a test prints by `eprintln` nobody sees, if it passes.
fn say_once(what: &str) {
    static SAID: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    let mut said = SAID.lock().unwrap_or_else(PoisonError::into_inner);
    if said.insert(what.to_owned()) {
        // It is as good as said if nobody can be told.
        let _ = writeln!(io::stderr(), "{what}");
    }
}

/// A scene as it is searched by each instruction set that this processor has, the best last.
pub fn by_each_set<T: Precision>(scene: &Scene<T>) -> impl Iterator<Item = Scene<T>> {
    let sets = InstructionSet::available().into_iter();
    sets.map(|set| scene.clone().with_instructions(set))
}

/// How many instruction sets of this processor have vectors: all but the portable one. Only those have packets.
pub fn count_with_vectors() -> usize {
    InstructionSet::available().into_iter().filter(|&set| set != InstructionSet::PORTABLE).count()
}

/// Whether a scene has packets if it is searched by `set`. Where it has none, its packets are batches.
pub fn has_packets<T: Precision>(scene: &Scene<T>, set: InstructionSet) -> bool {
    T::FITS_TREE && set != InstructionSet::PORTABLE && scene.wide_tree().is_some()
}

/// How many rays packets answered, by what those rays share. The others were left to the kernels of single rays, whose
/// answers say nothing about packets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Together {
    /// Rays from one origin.
    pub origin: usize,
    /// Rays along one direction.
    pub direction: usize,
    /// Rays to one target.
    pub target: usize,
}

impl Together {
    /// Those of one packet.
    pub fn of(packet: &RayPacket<'_>, work: PacketWork) -> Self {
        let (count, none) = (packet.len() - work.left, Self::default());
        match packet.common() {
            Common::Origin(_) => Self { origin: count, ..none },
            Common::Direction(_) => Self { direction: count, ..none },
            Common::Target(_) => Self { target: count, ..none },
        }
    }
}

impl AddAssign for Together {
    fn add_assign(&mut self, other: Self) {
        self.origin += other.origin;
        self.direction += other.direction;
        self.target += other.target;
    }
}

/// How many rays of a packet were answered as one by all instruction sets: of closest hits, and of any.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Answered {
    /// By queries for closest hits.
    pub closest: usize,
    /// By queries for any hits.
    pub any: usize,
}

/// Makes sure that by each instruction set a packet gets the answers that the scalar traversal gives its rays.
///
/// # Panics
/// If it does not.
pub fn assert_packet_agrees<T: Precision>(scene: &Scene<T>, packet: &RayPacket<'_>) -> Answered {
    let rays = (0..packet.len()).map(|index| packet.ray(index));
    let expected: Vec<_> = rays.map(|ray| (scene.shapes().closest_hit(&ray), ray)).collect();
    let mut answered = Answered::default();
    for scene in by_each_set(scene) {
        let (mut hits, mut found) = (HitArrays::default(), vec![false; packet.len()]);
        answered.closest += packet.len() - scene.packet_closest_hits(packet, &mut hits).left;
        answered.any += packet.len() - scene.packet_any_hits(packet, &mut found).left;
        for (index, (expected, ray)) in expected.iter().enumerate() {
            assert_eq!((hits.get(index), found[index]), (*expected, expected.is_some()), "{ray:?}");
        }
    }
    answered
}
