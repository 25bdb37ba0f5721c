//! What is looked for: the closest hit, or any.

use super::aim::Aim;
use super::block::BlockTest;
use super::float::FloatHit;
use super::lanes::RayLanes;
use crate::geometry::Ray;
use crate::layout::TriangleBlock;
use crate::primitives::{Hit, HitRule, intersect_triangle};
use crate::simd::Lanes;
use fearless_simd::prelude::*;

/// A search along one ray: all that the traversals do not share.
pub(crate) trait Search: Sized {
    /// What is found; by default nothing.
    type Answer: Default;

    /// Nothing is found yet.
    fn new(ray: &Ray<3>, aim: &Aim) -> Self;

    /// Where the part of the ray ends that is still open, in the kernels' t.
    fn t_far(&self) -> f32;

    /// Looks at the triangles of a block; true if the search is over.
    fn visit<S: Lanes>(
        &mut self,
        simd: S,
        block: &TriangleBlock,
        aim: &Aim,
        lanes: &mut RayLanes<S>,
    ) -> bool;

    /// What was found.
    fn answer(&self) -> Self::Answer;
}

/// The closest hit; decided exactly if EXACT, else in plain floating point.
pub(crate) struct Closest<const EXACT: bool> {
    best: Option<Hit>,
    /// The ray up to the best hit.
    open: Ray<3>,
    t_far: f32,
}

impl<const EXACT: bool> Search for Closest<EXACT> {
    type Answer = Option<Hit>;

    #[inline(always)]
    fn new(ray: &Ray<3>, aim: &Aim) -> Self {
        Self { best: None, open: *ray, t_far: aim.t_far }
    }

    #[inline(always)]
    fn t_far(&self) -> f32 {
        self.t_far
    }

    #[inline(always)]
    fn visit<S: Lanes>(
        &mut self,
        simd: S,
        block: &TriangleBlock,
        aim: &Aim,
        lanes: &mut RayLanes<S>,
    ) -> bool {
        let shorter = if EXACT {
            let test = BlockTest::new::<true>(simd, block, aim, lanes);
            self.decide(block, test.candidates(lanes).to_bitmask(), aim)
        } else {
            self.keep(FloatHit::nearest(simd, block, aim, lanes))
        };
        if shorter {
            lanes.end(simd, aim, self.t_far);
        }
        false
    }

    #[inline(always)]
    fn answer(&self) -> Option<Hit> {
        self.best
    }
}

impl<const EXACT: bool> Closest<EXACT> {
    /// Decides exactly which of the candidates is the best hit; true if one is better than before.
    #[inline(always)]
    fn decide(&mut self, block: &TriangleBlock, mut candidates: u64, aim: &Aim) -> bool {
        let mut is_better = false;
        while candidates != 0 {
            let lane = candidates.trailing_zeros() as usize;
            candidates &= candidates - 1;
            let (corners, id) = (block.triangle(lane), block.id(lane));
            let hit = intersect_triangle(&corners, id, &self.open, HitRule::Touching);
            if let Some(hit) = hit
                && self.best.is_none_or(|best| hit.precedes(&best))
            {
                self.best = Some(hit);
                self.open.interval.t_max = hit.t;
                self.t_far = aim.kernel_t_above(hit.t).min(self.t_far);
                is_better = true;
            }
        }
        is_better
    }

    /// Keeps a hit if it is better than the best.
    #[inline(always)]
    fn keep(&mut self, found: Option<FloatHit>) -> bool {
        let Some(FloatHit { t, hit }) = found else { return false };
        let is_better = self.best.is_none_or(|best| hit.precedes(&best));
        if is_better {
            (self.best, self.t_far) = (Some(hit), t);
        }
        is_better
    }
}

/// Whether there is any hit; decided exactly if EXACT, else in plain floating point.
pub(crate) struct Any<const EXACT: bool> {
    ray: Ray<3>,
    t_far: f32,
    is_hit: bool,
}

impl<const EXACT: bool> Search for Any<EXACT> {
    type Answer = bool;

    #[inline(always)]
    fn new(ray: &Ray<3>, aim: &Aim) -> Self {
        Self { ray: *ray, t_far: aim.t_far, is_hit: false }
    }

    #[inline(always)]
    fn t_far(&self) -> f32 {
        self.t_far
    }

    #[inline(always)]
    fn visit<S: Lanes>(
        &mut self,
        simd: S,
        block: &TriangleBlock,
        aim: &Aim,
        lanes: &mut RayLanes<S>,
    ) -> bool {
        let test = BlockTest::new::<EXACT>(simd, block, aim, lanes);
        let candidates = test.candidates(lanes).to_bitmask();
        self.is_hit = candidates != 0
            && (candidates & test.sure(lanes).to_bitmask() != 0
                || EXACT && any_is_hit(block, candidates, &self.ray));
        self.is_hit
    }

    #[inline(always)]
    fn answer(&self) -> bool {
        self.is_hit
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
