//! Any hit.

use super::aim::Aim;
use super::block::BlockTest;
use super::search::{Search, triangle};
use crate::geometry::{Coordinate, Ray};
use crate::layout::TriangleBlock;
use crate::primitives::{HitRule, TriangleMesh, intersect_triangle};
use crate::simd::Lanes;
use fearless_simd::prelude::*;

/// Whether there is any hit; decided exactly if EXACT, else in plain floating point.
pub(crate) struct Any<'a, T: 'static, const EXACT: bool> {
    mesh: &'a TriangleMesh<T>,
    ray: Ray<3>,
    is_hit: bool,
}

impl<'a, T: Coordinate, const EXACT: bool> Search<'a> for Any<'a, T, EXACT> {
    type Coordinate = T;
    type Answer = bool;
    const SHORTENS: bool = false;

    #[inline(always)]
    fn new(ray: &Ray<3>, mesh: &'a TriangleMesh<T>, _: &mut bool) -> Self {
        Self { mesh, ray: *ray, is_hit: false }
    }

    #[inline(always)]
    fn visit<S: Lanes>(&mut self, simd: S, block: &TriangleBlock, aim: &mut Aim) -> bool {
        let test = BlockTest::new::<T, EXACT>(simd, block, aim);
        let candidates = test.candidates(aim).to_bitmask();
        self.is_hit = candidates != 0
            && (candidates & test.sure(aim).to_bitmask() != 0
                || EXACT && any_is_hit(self.mesh, block, candidates, &self.ray));
        self.is_hit
    }

    #[inline(always)]
    fn answer(&mut self, answer: &mut bool) {
        *answer = self.is_hit;
    }
}

/// Decides exactly whether one of the candidates is hit.
#[inline(never)]
fn any_is_hit<T: Coordinate>(
    mesh: &TriangleMesh<T>,
    block: &TriangleBlock,
    mut candidates: u64,
    ray: &Ray<3>,
) -> bool {
    while candidates != 0 {
        let lane = candidates.trailing_zeros() as usize;
        let (corners, id) = (triangle(mesh, block, lane), block.id(lane));
        if intersect_triangle(&corners, id, ray, HitRule::Touching).is_some() {
            return true;
        }
        candidates &= candidates - 1;
    }
    false
}
