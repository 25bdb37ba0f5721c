//! Instruction sets.

use kdray::primitives::HitArrays;
use kdray::{InstructionSet, Precision, RayPacket, Scene};
use std::collections::BTreeSet;
use std::io::{self, Write};
use std::sync::{Mutex, PoisonError};

/// The set of a name. `None` if this processor does not have it: then this says so, once, and no more, with the
/// environment variable `CI` neither, for processors differ.
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

/// Makes sure that by each instruction set a packet gets the answers that the scalar traversal gives its rays.
///
/// # Panics
/// If it does not.
pub fn assert_packet_agrees<T: Precision>(scene: &Scene<T>, packet: &RayPacket<'_>) {
    let rays = (0..packet.len()).map(|index| packet.ray(index));
    let expected: Vec<_> = rays.map(|ray| (scene.shapes().closest_hit(&ray), ray)).collect();
    for scene in by_each_set(scene) {
        let (mut hits, mut found) = (HitArrays::default(), vec![false; packet.len()]);
        scene.packet_closest_hits(packet, &mut hits);
        scene.packet_any_hits(packet, &mut found);
        for (index, (expected, ray)) in expected.iter().enumerate() {
            assert_eq!((hits.get(index), found[index]), (*expected, expected.is_some()), "{ray:?}");
        }
    }
}
