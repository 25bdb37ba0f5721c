//! One ray through the wide tree.

use super::aim::{Aim, NoAim};
use super::block::BlockTest;
use super::float::FloatHit;
use super::lanes::RayLanes;
use super::slab::nearest_child;
use super::stack::Stack;
use crate::geometry::Ray;
use crate::layout::{Link, TriangleBlock, WideTree};
use crate::primitives::{Hit, HitRule, intersect_triangle};
use crate::simd::{Kernel, Lanes};
use fearless_simd::prelude::*;

/// The closest hit on one ray; decided exactly if EXACT, else in plain floating point.
pub(crate) struct ClosestHit<'a, const EXACT: bool> {
    pub(crate) tree: &'a WideTree,
    pub(crate) ray: &'a Ray<3>,
}

/// Some hit on one ray; decided exactly if EXACT, else in plain floating point.
pub(crate) struct AnyHit<'a, const EXACT: bool> {
    pub(crate) tree: &'a WideTree,
    pub(crate) ray: &'a Ray<3>,
}

/// The best hit so far, and the part of the ray that is still open.
pub(super) struct Best {
    pub(super) hit: Option<Hit>,
    open: Ray<3>,
    pub(super) t_far: f32,
}

impl Best {
    #[inline(always)]
    pub(super) fn new(ray: &Ray<3>, aim: &Aim) -> Self {
        Self { hit: None, open: *ray, t_far: aim.t_far }
    }

    /// Looks for better hits among the triangles of a block, and shortens the ray to the best.
    #[inline(always)]
    pub(super) fn visit<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        block: &TriangleBlock,
        aim: &Aim,
        ray: &mut RayLanes<S>,
    ) {
        if EXACT {
            let mut lanes =
                BlockTest::new::<true>(simd, block, aim, ray).candidates(ray).to_bitmask();
            if lanes == 0 {
                return;
            }
            while lanes != 0 {
                self.decide(block, lanes.trailing_zeros() as usize, aim);
                lanes &= lanes - 1;
            }
        } else {
            let Some(found) = FloatHit::nearest(simd, block, aim, ray) else { return };
            let ties = self.hit.is_some_and(|hit| !found.hit.precedes(&hit));
            if !ties {
                (self.hit, self.t_far) = (Some(found.hit), found.t);
            }
        }
        ray.end(simd, aim, self.t_far);
    }

    /// Decides exactly whether a candidate is hit, and is the better hit.
    #[inline(always)]
    fn decide(&mut self, block: &TriangleBlock, lane: usize, aim: &Aim) {
        let (corners, id) = (block.triangle(lane), block.id(lane));
        let hit = intersect_triangle(&corners, id, &self.open, HitRule::Touching);
        if let Some(hit) = hit
            && self.hit.is_none_or(|best| hit.precedes(&best))
        {
            self.hit = Some(hit);
            self.open.interval.t_max = hit.t;
            self.t_far = aim.kernel_t_above(hit.t).min(self.t_far);
        }
    }
}

impl<const EXACT: bool> Kernel for ClosestHit<'_, EXACT> {
    type Output = Result<Option<Hit>, NoAim>;

    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) -> Self::Output {
        let Self { tree, ray } = self;
        let aim = &Aim::new(tree, ray)?;
        let mut lanes = RayLanes::new(simd, aim);
        let mut best = Best::new(ray, aim);
        let mut stack = Stack::new();
        let mut next = Some(Link::ROOT);
        while let Some(link) = next {
            if link.is_leaf() {
                for index in 0..link.block_count() {
                    best.visit::<S, EXACT>(simd, tree.block(link, index), aim, &mut lanes);
                }
                next = stack.pop(best.t_far);
            } else {
                next = nearest_child(simd, tree.node(link), aim, &lanes, &mut stack)
                    .or_else(|| stack.pop(best.t_far));
            }
        }
        Ok(best.hit)
    }
}

impl<const EXACT: bool> Kernel for AnyHit<'_, EXACT> {
    type Output = Result<bool, NoAim>;

    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) -> Self::Output {
        let Self { tree, ray } = self;
        let aim = &Aim::new(tree, ray)?;
        let lanes = RayLanes::new(simd, aim);
        let mut stack = Stack::new();
        let mut next = Some(Link::ROOT);
        while let Some(link) = next {
            if !link.is_leaf() {
                next = nearest_child(simd, tree.node(link), aim, &lanes, &mut stack)
                    .or_else(|| stack.pop(aim.t_far));
                continue;
            }
            for index in 0..link.block_count() {
                let block = tree.block(link, index);
                if occludes::<S, EXACT>(simd, block, ray, aim, &lanes) {
                    return Ok(true);
                }
            }
            next = stack.pop(aim.t_far);
        }
        Ok(false)
    }
}

/// Whether a triangle of a block is hit.
#[inline(always)]
pub(super) fn occludes<S: Lanes, const EXACT: bool>(
    simd: S,
    block: &TriangleBlock,
    ray: &Ray<3>,
    aim: &Aim,
    lanes: &RayLanes<S>,
) -> bool {
    let test = BlockTest::new::<EXACT>(simd, block, aim, lanes);
    let candidates = test.candidates(lanes).to_bitmask();
    if !EXACT {
        return candidates & test.sure(lanes).to_bitmask() != 0;
    }
    candidates != 0 && (test.sure(lanes).to_bitmask() != 0 || any_is_hit(block, candidates, ray))
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
