//! Vertices for formats that give each triangle its own.

use std::collections::HashMap;

/// Gives equal positions the same index, so that triangles that touch share vertices.
#[derive(Default)]
pub(crate) struct Welder {
    indices: HashMap<[u32; 3], u32>,
}

impl Welder {
    /// The index of the vertex at `position`, which is added to `vertices` if it is new. 0 and −0
    /// are equal; a NaN is equal to itself.
    pub(crate) fn index(&mut self, position: [f32; 3], vertices: &mut Vec<[f32; 3]>) -> u32 {
        // Adding 0 turns −0 into 0.
        let bits = position.map(|x| (x + 0.0).to_bits());
        *self.indices.entry(bits).or_insert_with(|| {
            vertices.push(position);
            (vertices.len() - 1) as u32
        })
    }
}
