//! Eight triangles side by side.

use bytemuck::{Pod, Zeroable};

/// Eight triangles in 320 bytes, each number of each in a lane.
///
/// Corners are turned so that the longest edge lies opposite the first, because the error bound of
/// the test grows with the two edges that meet there. A lane without triangle holds NaN, for which
/// no comparison is true.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(64))]
pub(crate) struct TriangleBlock {
    corners: [[[f32; 8]; 3]; 3],
    /// The primitive's id, and in the upper two bits by how many places its corners are turned.
    ids: [u32; 8],
}

const ID_BITS: u32 = 30;

impl TriangleBlock {
    /// Most triangles that a block has.
    pub(crate) const WIDTH: usize = 8;

    /// A block of up to eight triangles.
    pub(super) fn new(triangles: impl IntoIterator<Item = (u32, [[f32; 3]; 3])>) -> Self {
        let mut block = Self { corners: [[[f32::NAN; 8]; 3]; 3], ids: [0; 8] };
        for (lane, (id, corners)) in triangles.into_iter().enumerate() {
            let turns = opposite_longest_edge(&corners);
            for (place, rows) in block.corners.iter_mut().enumerate() {
                let corner = corners[(place + turns) % 3];
                rows.iter_mut().zip(corner).for_each(|(row, x)| row[lane] = x);
            }
            block.ids[lane] = id | (turns as u32) << ID_BITS;
        }
        block
    }

    /// How many triangles there are.
    pub(super) fn triangle_count(&self) -> u32 {
        self.corners[0][0].iter().map(|x| u32::from(!x.is_nan())).sum()
    }

    /// Whether all ids, those of lanes without triangle too, are below `count`.
    pub(super) fn has_ids_below(&self, count: u32) -> bool {
        self.ids.iter().fold(true, |all, id| all & (id & ((1 << ID_BITS) - 1) < count))
    }

    /// The eight values of a corner on an axis.
    #[inline(always)]
    pub(crate) fn corner(&self, place: usize, axis: usize) -> &[f32; 8] {
        &self.corners[place][axis]
    }

    /// The id of the triangle in a lane.
    #[inline(always)]
    pub(crate) fn id(&self, lane: usize) -> u32 {
        self.ids[lane & 7] & ((1 << ID_BITS) - 1)
    }

    /// By how many places the corners of the triangle in a lane are turned: its corner i stands at
    /// place i − turns.
    #[inline(always)]
    pub(crate) fn turns(&self, lane: usize) -> usize {
        (self.ids[lane & 7] >> ID_BITS) as usize
    }

    /// The triangle in a lane, its corners a, b, c in the mesh's order.
    #[inline(always)]
    pub(crate) fn triangle(&self, lane: usize) -> [[f32; 3]; 3] {
        // Not by `map`, which is not always compiled into the kernels.
        let corner = |[x, y, z]: &[[f32; 8]; 3]| [x[lane & 7], y[lane & 7], z[lane & 7]];
        let [p, q, r] = &self.corners;
        let [p, q, r] = [corner(p), corner(q), corner(r)];
        match self.turns(lane) {
            0 => [p, q, r],
            1 => [r, p, q],
            _ => [q, r, p],
        }
    }
}

/// The corner that lies opposite the longest edge.
fn opposite_longest_edge([a, b, c]: &[[f32; 3]; 3]) -> usize {
    let length = |p: &[f32; 3], q: &[f32; 3]| {
        // Not by `powi`, which promises no precision: the same mesh gives the same blocks.
        let along = |k: usize| f64::from(p[k]) - f64::from(q[k]);
        along(0) * along(0) + along(1) * along(1) + along(2) * along(2)
    };
    let opposite = [length(b, c), length(c, a), length(a, b)];
    (1..3).fold(0, |most, i| if opposite[i] > opposite[most] { i } else { most })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_come_back_whichever_edge_is_longest() {
        let (a, b, c) = ([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.5]);
        let triangles = [[a, b, c], [b, c, a], [c, a, b], [a, c, b]];
        let block = TriangleBlock::new((7..).zip(triangles));
        for (lane, triangle) in triangles.into_iter().enumerate() {
            assert_eq!((block.id(lane), block.triangle(lane)), (7 + lane as u32, triangle));
            let first: [f32; 3] = std::array::from_fn(|axis| block.corner(0, axis)[lane]);
            assert_eq!(first, a, "the longest edge is from b to c");
        }
        assert!(block.corner(0, 0)[4].is_nan());
    }
}
