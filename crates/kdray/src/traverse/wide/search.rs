//! What a traversal asks of what it looks for.

use super::aim::Aim;
use crate::geometry::Ray;
use crate::layout::TriangleBlock;
use crate::simd::Lanes;

/// A search along one ray: all that the traversals do not share.
pub(crate) trait Search<'a>: Sized {
    /// What is found; by default nothing.
    type Answer: Default;

    /// Whether hits end the open part of the ray; if not, all that the ray meets is to be visited.
    const SHORTENS: bool;

    /// Nothing is found yet.
    fn new(ray: &Ray<3>) -> Self;

    /// Looks at the triangles of a block, and ends the open part of the ray at the best hit; true
    /// if the search is over.
    fn visit<S: Lanes>(&mut self, simd: S, block: &'a TriangleBlock, aim: &mut Aim) -> bool;

    /// Sets the answer to what was found.
    fn answer(&self, answer: &mut Self::Answer);
}
