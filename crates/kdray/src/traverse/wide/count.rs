//! How many hits there are.

use super::aim::Aim;
use super::block::BlockTest;
use super::recent::Recent;
use super::search::{Search, triangle};
use crate::geometry::{Coordinate, Ray};
use crate::layout::TriangleBlock;
use crate::primitives::{HitRule, TriangleMesh, intersect_triangle};
use crate::simd::Lanes;
use fearless_simd::prelude::*;

/// The triangles that the ray crosses. What surely is hit needs no numbers, and is not tested again.
pub(crate) struct Count<'a, T: 'static> {
    pub(super) mesh: &'a TriangleMesh<T>,
    ray: Ray<3>,
    /// In the order in which they were found; a triangle may be in several leaves.
    ids: Vec<u32>,
    tested: Recent,
}

impl<'a, T: Coordinate> Search<'a> for Count<'a, T> {
    type Coordinate = T;
    /// The primitive ids, each once.
    type Answer = Vec<u32>;
    const SHORTENS: bool = false;

    #[inline(always)]
    fn new(ray: &Ray<3>, mesh: &'a TriangleMesh<T>, answer: &mut Vec<u32>) -> Self {
        let mut ids = std::mem::take(answer);
        ids.clear();
        Self { mesh, ray: *ray, ids, tested: Recent::NONE }
    }

    #[inline(always)]
    fn visit<S: Lanes>(&mut self, simd: S, block: &TriangleBlock, aim: &mut Aim) -> bool {
        let test = BlockTest::new::<T, true>(simd, block, aim);
        let candidates = test.candidates(aim).to_bitmask();
        if candidates != 0 {
            self.add(block, candidates, test.sure(aim).to_bitmask());
        }
        false
    }

    #[inline(always)]
    fn answer(&mut self, answer: &mut Vec<u32>) {
        leave_one_each(&mut self.ids);
        std::mem::swap(answer, &mut self.ids);
    }
}

impl<T: Coordinate> Count<'_, T> {
    /// Adds the candidates that are sure, and those that exact arithmetic says are crossed.
    #[inline(never)]
    pub(super) fn add(&mut self, block: &TriangleBlock, mut candidates: u64, sure: u64) {
        while candidates != 0 {
            let lane = candidates.trailing_zeros() as usize;
            candidates &= candidates - 1;
            let id = block.id(lane);
            if self.tested.add(id) && (sure >> lane & 1 == 1 || self.is_crossed(block, lane)) {
                self.ids.push(id);
            }
        }
    }

    fn is_crossed(&self, block: &TriangleBlock, lane: usize) -> bool {
        let (corners, id) = (triangle(self.mesh, block, lane), block.id(lane));
        intersect_triangle(&corners, id, &self.ray, HitRule::Crossing).is_some()
    }
}

/// Leaves one of equal ids.
#[inline(never)]
fn leave_one_each(ids: &mut Vec<u32>) {
    ids.sort_unstable();
    ids.dedup();
}
