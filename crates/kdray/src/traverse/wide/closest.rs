//! The closest hit.

use super::aim::Aim;
use super::block::{BlockTest, Depths};
use super::float::FloatHit;
use super::search::{Search, triangle};
use crate::geometry::{Coordinate, Ray};
use crate::layout::TriangleBlock;
use crate::primitives::{Hit, HitRule, TriangleMesh, intersect_triangle};
use crate::simd::Lanes;
use fearless_simd::prelude::*;

/// The closest hit; decided exactly if EXACT, else in plain floating point.
///
/// A triangle that is surely hit, and surely before all others so far, is only noted: its hit is
/// computed when the search is over, or when another comes so close that the filter cannot tell
/// which is first.
pub(crate) struct Closest<'a, T: 'static, const EXACT: bool> {
    mesh: &'a TriangleMesh<T>,
    /// The best hit that was computed, unless one that is noted is before it.
    best: Option<Hit>,
    noted: Option<(&'a TriangleBlock, usize)>,
    /// The ray up to the best hit that was computed.
    open: Ray<3>,
    /// Where the best hit, computed or noted, is at the least, in the kernels' t.
    t_low: f32,
}

impl<'a, T: Coordinate, const EXACT: bool> Search<'a> for Closest<'a, T, EXACT> {
    type Coordinate = T;
    type Answer = Option<Hit>;
    const SHORTENS: bool = true;

    #[inline(always)]
    fn new(ray: &Ray<3>, mesh: &'a TriangleMesh<T>, _: &mut Option<Hit>) -> Self {
        Self { mesh, best: None, noted: None, open: *ray, t_low: f32::INFINITY }
    }

    #[inline(always)]
    fn visit<S: Lanes>(&mut self, simd: S, block: &'a TriangleBlock, aim: &mut Aim) -> bool {
        if EXACT {
            let test = BlockTest::new::<T, true>(simd, block, aim);
            let candidates = test.candidates(aim).to_bitmask();
            if candidates != 0 {
                self.narrow(block, candidates, &test.depths(simd, aim), aim);
            }
        } else if let Some(found) = FloatHit::nearest(simd, block, aim) {
            self.keep(found, aim);
        }
        false
    }

    #[inline(always)]
    fn answer(&mut self, answer: &mut Option<Hit>) {
        *answer = match self.noted {
            Some((block, lane)) => self.compute(block, lane),
            None => self.best,
        };
    }
}

impl<'a, T: Coordinate, const EXACT: bool> Closest<'a, T, EXACT> {
    /// Finds which of the candidates may be the best hit: notes it if there is one that surely is,
    /// otherwise decides exactly.
    #[inline(always)]
    fn narrow<S: Lanes>(
        &mut self,
        block: &'a TriangleBlock,
        candidates: u64,
        depths: &Depths<S>,
        aim: &mut Aim,
    ) {
        let t_high = depths.high.reduce_min();
        let rivals = candidates & depths.low.simd_le(t_high).to_bitmask();
        let is_first = t_high < self.t_low;
        if is_first {
            (self.best, self.noted) = (None, None);
        }
        let lane = rivals.trailing_zeros() as usize & 7;
        if is_first && rivals.is_power_of_two() {
            self.noted = Some((block, lane));
            self.t_low = depths.low.as_array()[lane];
            aim.end(aim.t_far.min(t_high));
        } else if !(rivals.is_power_of_two() && self.is_best(block.id(lane))) {
            self.decide(block, rivals, aim);
        }
    }

    /// Whether this triangle is the best so far: leaves share triangles.
    #[inline(always)]
    fn is_best(&self, id: u32) -> bool {
        match self.noted {
            Some((block, lane)) => block.id(lane) == id,
            None => self.best.is_some_and(|best| best.primitive_id == id),
        }
    }

    /// Decides exactly which of the candidates, the noted and the best is the best hit.
    #[inline(never)]
    fn decide(&mut self, block: &'a TriangleBlock, mut candidates: u64, aim: &mut Aim) {
        if let Some((block, lane)) = self.noted.take() {
            self.try_lane(block, lane, aim);
        }
        while candidates != 0 {
            self.try_lane(block, candidates.trailing_zeros() as usize, aim);
            candidates &= candidates - 1;
        }
    }

    fn try_lane(&mut self, block: &TriangleBlock, lane: usize, aim: &mut Aim) {
        if let Some(hit) = self.compute(block, lane)
            && self.best.is_none_or(|best| hit.precedes(&best))
        {
            self.best = Some(hit);
            self.open.interval.t_max = hit.t;
            let (t_low, t_high) = aim.kernel_t_around(hit.t);
            self.t_low = t_low;
            aim.end(aim.t_far.min(t_high));
        }
    }

    #[inline(always)]
    fn compute(&self, block: &TriangleBlock, lane: usize) -> Option<Hit> {
        let (corners, id) = (triangle(self.mesh, block, lane), block.id(lane));
        intersect_triangle(&corners, id, &self.open, HitRule::Touching)
    }

    /// Keeps a hit if it is better than the best.
    #[inline(always)]
    fn keep(&mut self, FloatHit { t, hit }: FloatHit, aim: &mut Aim) {
        if self.best.is_none_or(|best| hit.precedes(&best)) {
            self.best = Some(hit);
            aim.end(t);
        }
    }
}
