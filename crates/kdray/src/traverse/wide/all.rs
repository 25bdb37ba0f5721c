//! All hits.

use super::aim::Aim;
use super::block::BlockTest;
use super::recent::Recent;
use super::search::{Search, triangle};
use crate::geometry::{Coordinate, Ray};
use crate::layout::TriangleBlock;
use crate::primitives::{Hit, HitRule, TriangleMesh, intersect_triangle};
use crate::simd::Lanes;
use fearless_simd::prelude::*;

/// Every crossing, decided exactly. Nothing ends the search early, so leaves may come in any order.
pub(crate) struct All<'a, T: 'static> {
    mesh: &'a TriangleMesh<T>,
    ray: Ray<3>,
    /// In the order in which they were found.
    hits: Vec<Hit>,
    tested: Recent,
}

impl<'a, T: Coordinate> Search<'a> for All<'a, T> {
    type Coordinate = T;
    type Answer = Vec<Hit>;
    const SHORTENS: bool = false;

    #[inline(always)]
    fn new(ray: &Ray<3>, mesh: &'a TriangleMesh<T>, answer: &mut Vec<Hit>) -> Self {
        let mut hits = std::mem::take(answer);
        hits.clear();
        Self { mesh, ray: *ray, hits, tested: Recent::NONE }
    }

    #[inline(always)]
    fn visit<S: Lanes>(&mut self, simd: S, block: &TriangleBlock, aim: &mut Aim) -> bool {
        let test = BlockTest::new::<T, true>(simd, block, aim);
        let candidates = test.candidates(aim).to_bitmask();
        if candidates != 0 {
            self.add(block, candidates);
        }
        false
    }

    /// The hits by rising t, equal t by rising id.
    #[inline(always)]
    fn answer(&mut self, answer: &mut Vec<Hit>) {
        put_in_order(&mut self.hits);
        std::mem::swap(answer, &mut self.hits);
    }
}

impl<T: Coordinate> All<'_, T> {
    /// Adds those of the candidates that are crossed.
    #[inline(never)]
    fn add(&mut self, block: &TriangleBlock, mut candidates: u64) {
        while candidates != 0 {
            let lane = candidates.trailing_zeros() as usize;
            candidates &= candidates - 1;
            let id = block.id(lane);
            if self.tested.add(id) {
                let corners = triangle(self.mesh, block, lane);
                self.hits.extend(intersect_triangle(&corners, id, &self.ray, HitRule::Crossing));
            }
        }
    }
}

/// Sorts the hits, and leaves one of those of the same triangle, which are the same.
#[inline(never)]
fn put_in_order(hits: &mut Vec<Hit>) {
    hits.sort_unstable_by(Hit::order);
    hits.dedup_by_key(|hit| hit.primitive_id);
}
