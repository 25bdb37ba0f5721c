//! What is looked for: the closest hit, or any.

use super::aim::Aim;
use super::block::{BlockTest, Depths};
use super::float::FloatHit;
use crate::geometry::Ray;
use crate::layout::TriangleBlock;
use crate::primitives::{Hit, HitRule, intersect_triangle};
use crate::simd::Lanes;
use fearless_simd::prelude::*;

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

/// The closest hit; decided exactly if EXACT, else in plain floating point.
///
/// A triangle that is surely hit, and surely before all others so far, is only noted: its hit is
/// computed when the search is over, or when another comes so close that the filter cannot tell
/// which is first.
pub(crate) struct Closest<'a, const EXACT: bool> {
    /// The best hit that was computed, unless one that is noted is before it.
    best: Option<Hit>,
    noted: Option<(&'a TriangleBlock, usize)>,
    /// The ray up to the best hit that was computed.
    open: Ray<3>,
    /// Where the best hit, computed or noted, is at the least, in the kernels' t.
    t_low: f32,
}

impl<'a, const EXACT: bool> Search<'a> for Closest<'a, EXACT> {
    type Answer = Option<Hit>;
    const SHORTENS: bool = true;

    #[inline(always)]
    fn new(ray: &Ray<3>) -> Self {
        Self { best: None, noted: None, open: *ray, t_low: f32::INFINITY }
    }

    #[inline(always)]
    fn visit<S: Lanes>(&mut self, simd: S, block: &'a TriangleBlock, aim: &mut Aim) -> bool {
        if EXACT {
            let test = BlockTest::new::<true>(simd, block, aim);
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
    fn answer(&self, answer: &mut Option<Hit>) {
        *answer = match self.noted {
            Some((block, lane)) => self.compute(block, lane),
            None => self.best,
        };
    }
}

impl<'a, const EXACT: bool> Closest<'a, EXACT> {
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
        let (corners, id) = (block.triangle(lane), block.id(lane));
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

/// Whether there is any hit; decided exactly if EXACT, else in plain floating point.
pub(crate) struct Any<const EXACT: bool> {
    ray: Ray<3>,
    is_hit: bool,
}

impl<const EXACT: bool> Search<'_> for Any<EXACT> {
    type Answer = bool;
    const SHORTENS: bool = false;

    #[inline(always)]
    fn new(ray: &Ray<3>) -> Self {
        Self { ray: *ray, is_hit: false }
    }

    #[inline(always)]
    fn visit<S: Lanes>(&mut self, simd: S, block: &TriangleBlock, aim: &mut Aim) -> bool {
        let test = BlockTest::new::<EXACT>(simd, block, aim);
        let candidates = test.candidates(aim).to_bitmask();
        self.is_hit = candidates != 0
            && (candidates & test.sure(aim).to_bitmask() != 0
                || EXACT && any_is_hit(block, candidates, &self.ray));
        self.is_hit
    }

    #[inline(always)]
    fn answer(&self, answer: &mut bool) {
        *answer = self.is_hit;
    }
}

/// Decides exactly whether one of the candidates is hit.
#[inline(never)]
fn any_is_hit(block: &TriangleBlock, mut candidates: u64, ray: &Ray<3>) -> bool {
    while candidates != 0 {
        let lane = candidates.trailing_zeros() as usize;
        let (corners, id) = (block.triangle(lane), block.id(lane));
        if intersect_triangle(&corners, id, ray, HitRule::Touching).is_some() {
            return true;
        }
        candidates &= candidates - 1;
    }
    false
}
