//! Instruction sets.

use kdray::primitives::HitArrays;
use kdray::{InstructionSet, Precision, RayPacket, Scene};

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
