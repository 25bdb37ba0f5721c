//! What a traversal asks of what it looks for.

use super::aim::Aim;
use crate::geometry::{Coordinate, Ray};
use crate::layout::TriangleBlock;
use crate::primitives::TriangleMesh;
use crate::simd::Lanes;

/// A search along one ray: all that the traversals do not share.
pub(crate) trait Search<'a>: Sized {
    /// What the mesh's coordinates are.
    type Coordinate: Coordinate;

    /// What is found; by default nothing.
    type Answer: Default;

    /// Whether hits end the open part of the ray; if not, all that the ray meets is to be visited.
    const SHORTENS: bool;

    /// Nothing is found yet. `answer` may have room that is used; what it says is lost.
    fn new(
        ray: &Ray<3>,
        mesh: &'a TriangleMesh<Self::Coordinate>,
        answer: &mut Self::Answer,
    ) -> Self;

    /// Looks at the triangles of a block, and ends the open part of the ray at the best hit; true
    /// if the search is over.
    fn visit<S: Lanes>(&mut self, simd: S, block: &'a TriangleBlock, aim: &mut Aim) -> bool;

    /// Sets the answer to what was found.
    fn answer(&mut self, answer: &mut Self::Answer);
}

/// The triangle in a lane of a block, as it is in the mesh. Copies in blocks are rounded if the mesh does
/// not fit the tree; otherwise they are at hand.
#[inline(always)]
pub(super) fn triangle<T: Coordinate>(
    mesh: &TriangleMesh<T>,
    block: &TriangleBlock,
    lane: usize,
) -> [[T; 3]; 3] {
    if !T::FITS_TREE {
        return mesh.corners(block.id(lane));
    }
    // Not by `map`, which is not always compiled into the kernels.
    let corner = |[x, y, z]: [f32; 3]| [T::from_f32(x), T::from_f32(y), T::from_f32(z)];
    let [a, b, c] = block.triangle(lane);
    [corner(a), corner(b), corner(c)]
}
