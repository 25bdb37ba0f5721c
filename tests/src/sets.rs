//! Instruction sets.

use kdray::{InstructionSet, Precision, Scene};

/// A scene as it is searched by each instruction set that this processor has, the best last.
pub fn by_each_set<T: Precision>(scene: &Scene<T>) -> impl Iterator<Item = Scene<T>> {
    let sets = InstructionSet::available().into_iter();
    sets.map(|set| scene.clone().with_instructions(set))
}
