//! The closest hit, with where it was found.

use super::aim::Aim;
use super::closest::Closest;
use super::search::Search;
use crate::geometry::{Coordinate, Ray};
use crate::layout::TriangleBlock;
use crate::primitives::{Hit, TriangleMesh};
use crate::simd::Lanes;

/// The closest hit and the block it was found in, to make a hint of: the last block that shortened
/// the ray. That need not be right, for a hint may be of any place.
pub(crate) struct Located<'a, T: 'static, const EXACT: bool> {
    closest: Closest<'a, T, EXACT>,
    block: Option<&'a TriangleBlock>,
}

impl<'a, T: Coordinate, const EXACT: bool> Search<'a> for Located<'a, T, EXACT> {
    type Coordinate = T;
    type Answer = Option<(Hit, Option<&'a TriangleBlock>)>;
    const SHORTENS: bool = true;

    #[inline(always)]
    fn new(ray: &Ray<3>, mesh: &'a TriangleMesh<T>, _: &mut Self::Answer) -> Self {
        Self { closest: Closest::new(ray, mesh, &mut None), block: None }
    }

    #[inline(always)]
    fn visit<S: Lanes>(&mut self, simd: S, block: &'a TriangleBlock, aim: &mut Aim) -> bool {
        let t_far = aim.t_far;
        let is_over = self.closest.visit(simd, block, aim);
        if aim.t_far < t_far {
            self.block = Some(block);
        }
        is_over
    }

    #[inline(always)]
    fn answer(&mut self, answer: &mut Self::Answer) {
        let mut hit = None;
        self.closest.answer(&mut hit);
        if let Some(hit) = hit {
            *answer = Some((hit, self.block));
        }
    }
}
