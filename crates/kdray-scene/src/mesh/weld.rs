//! Vertices for formats that give each triangle its own.

use super::MeshBuilder;
use crate::{LoadError, Place};
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// Gives equal positions the same index, so that triangles that touch share vertices.
#[derive(Default)]
pub(crate) struct Welder {
    indices: HashMap<[u32; 3], u32>,
}

impl Welder {
    /// The index of the vertex at `position`, which is added to the model if it is new. 0 and −0
    /// are equal; a NaN is equal to itself.
    pub(crate) fn index(
        &mut self,
        position: [f32; 3],
        builder: &mut MeshBuilder<'_>,
        place: impl Fn() -> Place,
    ) -> Result<u32, LoadError> {
        // Adding 0 turns −0 into 0.
        let bits = position.map(|x| (x + 0.0).to_bits());
        match self.indices.entry(bits) {
            Entry::Occupied(known) => Ok(*known.get()),
            Entry::Vacant(new) => Ok(*new.insert(builder.vertex(position, place)?)),
        }
    }
}
