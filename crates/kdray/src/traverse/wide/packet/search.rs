//! What a packet's rays find in a block of triangles.

use super::forms::{Lines, Table, Within, value};
use super::pace::PacketWork;
use super::projection::Projection;
use super::rays::{Bounds, MOST_SETS, MOST_VECTORS, PacketRays, bits};
use crate::geometry::RayPacket;
use crate::layout::TriangleBlock;
use crate::primitives::{HitRule, intersect_triangle};
use crate::simd::Lanes;
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, u32x8};

/// Places of the mailbox.
const MAILBOX: usize = 64;

/// The search of one packet: for the closest hits, or for any if ANY.
pub(super) struct Search<'a, P, const ANY: bool> {
    pub(super) packet: &'a RayPacket<'a>,
    /// The index of its first ray.
    pub(super) first: usize,
    pub(super) projection: P,
    pub(super) rays: &'a mut PacketRays,
    pub(super) bounds: Bounds,
    /// The triangles that were met last: each is tested once for the packet, not once a leaf.
    pub(super) mailbox: [u32; MAILBOX],
    pub(super) table: Table,
    /// The triangles that are the best hits so far of some rays, or were.
    pub(super) found: &'a mut Vec<Found>,
    pub(super) work: PacketWork,
}

/// A triangle that some ray hits.
#[derive(Clone, Copy)]
pub(super) struct Found {
    pub(super) corners: [[f32; 3]; 3],
    pub(super) id: u32,
}

impl Found {
    #[inline(always)]
    fn new(block: &TriangleBlock, lane: usize) -> Self {
        Self { corners: block.triangle(lane), id: block.id(lane) }
    }
}

/// A triangle that is being tested, and its place among those that were found if a ray hits it.
#[derive(Clone, Copy)]
struct Candidate<'b> {
    block: &'b TriangleBlock,
    lane: usize,
    slot: u32,
}

impl<'a, P: Projection, const ANY: bool> Search<'a, P, ANY> {
    pub(super) const EMPTY_MAILBOX: [u32; MAILBOX] = [u32::MAX; MAILBOX];

    /// Tests the triangles of a block.
    #[inline(always)]
    pub(super) fn visit<S: Lanes>(&mut self, simd: S, block: &'a TriangleBlock) {
        let forms = self.projection.forms(simd, block, &self.bounds);
        let Within { mut good, early, others } = forms.within(simd, &self.bounds);
        self.work.blocks += 1;
        if good != 0 {
            forms.store(&mut self.table);
            while good != 0 {
                let lane = good.trailing_zeros() as usize & 7;
                good &= good - 1;
                if !self.is_new(block.id(lane)) {
                    continue;
                }
                let candidate = Candidate { block, lane, slot: self.found.len() as u32 };
                let lines: Lines<S> = self.table.lines(simd, lane);
                self.work.triangles += 1;
                let hits = if early >> lane & 1 == 1 {
                    self.try_sets::<S, true>(simd, &lines, candidate)
                } else {
                    self.try_sets::<S, false>(simd, &lines, candidate)
                };
                self.keep(simd, hits, candidate);
            }
        }
        if others != 0 {
            forms.store(&mut self.table);
            let others = others & !forms.mixed(simd, &self.bounds);
            if others != 0 {
                self.try_others(simd, block, others);
            }
        }
    }

    /// Keeps a triangle that became the best hit of some rays.
    #[inline(always)]
    fn keep<S: Lanes>(&mut self, simd: S, hits: u32, Candidate { block, lane, .. }: Candidate<'_>) {
        if hits != 0 {
            self.found.push(Found::new(block, lane));
            self.bounds.low = self.rays.least_low(simd);
        }
    }

    /// Notes a triangle; false if it was met before.
    #[inline(always)]
    fn is_new(&mut self, id: u32) -> bool {
        let place = &mut self.mailbox[id as usize % MAILBOX];
        std::mem::replace(place, id) != id
    }

    /// Tests one triangle against the sub-frusta, then against the rays in those that it meets; whether
    /// some became shorter. NEAR if the triangle may lie before the beginning of a ray.
    #[inline(always)]
    fn try_sets<S: Lanes, const NEAR: bool>(
        &mut self,
        simd: S,
        lines: &Lines<S>,
        candidate: Candidate<'_>,
    ) -> u32 {
        let mut hits = 0;
        let mut sets = lines.met(simd, &self.rays.tops);
        while sets != 0 {
            let index = sets.trailing_zeros() as usize % MOST_SETS;
            sets &= sets - 1;
            let mut vectors = lines.met(simd, &self.rays.sets[index]);
            self.work.tests += vectors.count_ones() as usize;
            while vectors != 0 {
                let vector = 8 * index + vectors.trailing_zeros() as usize % 8;
                vectors &= vectors - 1;
                hits |= self.try_rays::<S, NEAR>(simd, lines, candidate, vector);
            }
            let low = f32x8::load_array_ref(simd, &self.rays.sets[index].low);
            self.rays.tops.low[index] = low.reduce_min();
        }
        hits
    }

    /// Tests one triangle against eight rays; which of them became shorter.
    #[inline(always)]
    fn try_rays<S: Lanes, const NEAR: bool>(
        &mut self,
        simd: S,
        lines: &Lines<S>,
        candidate: Candidate<'_>,
        vector: usize,
    ) -> u32 {
        let rays = &mut *self.rays;
        let load =
            |numbers: &[[f32; 8]; MOST_VECTORS]| f32x8::load_array_ref(simd, &numbers[vector]);
        let (x, y) = (load(&rays.x), load(&rays.y));
        let (low, high) = (load(&rays.low), load(&rays.high));
        let [a, b, c] = &lines.edges;
        let inside = value(a, x, y).min(value(b, x, y)).min(value(c, x, y));
        let w = value(&lines.depth, x, y);
        let (w_low, w_high) = (w - lines.depth_error, w + lines.depth_error);
        let mut sure = inside.simd_gt(lines.edge_error) & w_low.simd_gt(high);
        if NEAR {
            sure &= w_high.simd_lt(load(&rays.near_low));
        }
        let dead = f32x8::splat(simd, f32::INFINITY);
        let (best_low, best_high) = if ANY { (dead, dead) } else { (w_low, w_high) };
        let low = sure.select(best_low, low);
        rays.high[vector] = *sure.select(best_high, high).as_array();
        rays.low[vector] = *low.as_array();
        rays.sets[vector / 8].low[vector % 8] = low.reduce_min();
        let slots = u32x8::load_array_ref(simd, &rays.slot[vector]);
        let slot = u32x8::splat(simd, candidate.slot);
        rays.slot[vector] = *sure.select(slot, slots).as_array();
        let hit = bits(sure);
        let mut maybe = inside.simd_ge(-lines.edge_error) & w_high.simd_ge(low);
        if NEAR {
            maybe &= w_low.simd_le(load(&rays.near_high));
        }
        let doubtful = bits(maybe) & !hit;
        if doubtful != 0 {
            let decided = self.decide(candidate, vector, doubtful);
            self.rays.shorten(simd, vector);
            return hit | decided;
        }
        hit
    }

    /// Decides exactly for rays of which the filter cannot tell; which of them became shorter.
    #[cold]
    #[inline(never)]
    fn decide(&mut self, candidate: Candidate<'_>, vector: usize, mut doubtful: u32) -> u32 {
        let mut hits = 0;
        while doubtful != 0 {
            let lane = doubtful.trailing_zeros() as usize & 7;
            doubtful &= doubtful - 1;
            hits |= u32::from(self.decide_one(candidate, vector, lane)) << lane;
        }
        hits
    }

    /// Decides exactly for one ray.
    fn decide_one(&mut self, candidate: Candidate<'_>, vector: usize, lane: usize) -> bool {
        let Candidate { block, lane: place, slot } = candidate;
        let id = block.id(place);
        let best = self.rays.slot[vector][lane];
        let best = self.found.get(best as usize);
        if best.is_some_and(|best| best.id == id) {
            return false;
        }
        let ray = self.packet.ray(self.first + 8 * vector + lane);
        self.work.exact += 1;
        let on = |Found { corners, id }: &Found| {
            intersect_triangle(corners, *id, &ray, HitRule::Touching)
        };
        let Some(hit) = on(&Found::new(block, place)) else { return false };
        if best.and_then(on).is_some_and(|best| !hit.precedes(&best)) {
            return false;
        }
        let (low, high) = if ANY {
            (f32::INFINITY, f32::INFINITY)
        } else {
            self.projection.w_around(&ray, hit.t)
        };
        self.rays.slot[vector][lane] = slot;
        self.rays.low[vector][lane] = low;
        self.rays.high[vector][lane] = high;
        true
    }

    /// Tests triangles that are seen so nearly edge-on that the sign of their forms is not known.
    #[cold]
    #[inline(never)]
    fn try_others<S: Lanes>(&mut self, simd: S, block: &'a TriangleBlock, mut others: u32) {
        while others != 0 {
            let lane = others.trailing_zeros() as usize & 7;
            others &= others - 1;
            if !self.is_new(block.id(lane)) {
                continue;
            }
            let candidate = Candidate { block, lane, slot: self.found.len() as u32 };
            let lines: Lines<S> = self.table.lines(simd, lane);
            let mut hits = 0;
            for vector in 0..8 * self.rays.set_count {
                let vector = vector % MOST_VECTORS;
                let x = f32x8::load_array_ref(simd, &self.rays.x[vector]);
                let y = f32x8::load_array_ref(simd, &self.rays.y[vector]);
                let low = f32x8::load_array_ref(simd, &self.rays.low[vector]);
                let [a, b, c] = &lines.edges;
                let (a, b, c) = (value(a, x, y), value(b, x, y), value(c, x, y));
                // No comparison with NaN is true.
                let outside = a.min(b).min(c).simd_lt(-lines.edge_error)
                    & a.max(b).max(c).simd_gt(lines.edge_error);
                let doubtful = bits(low.simd_lt(f32::INFINITY)) & !bits(outside);
                if doubtful != 0 {
                    hits |= self.decide(candidate, vector, doubtful);
                    self.rays.shorten(simd, vector);
                }
            }
            self.rays.shorten_sets(simd);
            self.keep(simd, hits, candidate);
        }
    }
}
