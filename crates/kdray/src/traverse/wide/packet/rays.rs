//! The rays of one packet, as points of a plane.

use crate::simd::Lanes;
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, mask32x8};

/// Most rays of a packet: two tiles of 16 x 16 pixels, and as many sets as a vector has lanes.
pub(super) const MOST_RAYS: usize = 512;

/// Most vectors of eight rays.
pub(super) const MOST_VECTORS: usize = MOST_RAYS / 8;

/// Most sets of eight vectors.
pub(super) const MOST_SETS: usize = MOST_VECTORS / 8;

/// No triangle.
pub(super) const NONE: u32 = u32::MAX;

/// A number for each ray of a packet.
type Numbers = [[f32; 8]; MOST_VECTORS];

/// The rays of a packet. What they share makes each a point (x, y) of a plane, and depth along it a
/// number w that falls with t: see [`super::projection`]. The part of a ray that is open reaches from
/// somewhere between `near_high` and `near_low` down to somewhere between `high` and `low`.
pub(super) struct PacketRays {
    pub(super) x: Numbers,
    pub(super) y: Numbers,
    pub(super) near_low: Numbers,
    pub(super) near_high: Numbers,
    /// w at the far end of the open part is between these: at the best hit, or at t_max. Both are infinite
    /// for a ray that is dead: it takes no part.
    pub(super) low: Numbers,
    pub(super) high: Numbers,
    /// Which of the triangles that were found is the best hit so far; or [`NONE`].
    pub(super) slot: [[u32; 8]; MOST_VECTORS],
    /// The bounds of the vectors, eight of them a set.
    pub(super) sets: [Set; MOST_SETS],
    /// The bounds of the sets.
    pub(super) tops: Set,
    /// How many sets there are.
    pub(super) set_count: usize,
}

/// Bounds of eight vectors, one a lane: what their sub-frusta are. Those of a vector without open rays
/// are empty.
#[derive(Clone, Copy)]
pub(super) struct Set {
    /// The least and the greatest x, and y.
    pub(super) x: [[f32; 8]; 2],
    pub(super) y: [[f32; 8]; 2],
    /// The least `low`.
    pub(super) low: [f32; 8],
}

/// Bounds of all rays: what the bounding frustum is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) x: [f32; 2],
    pub(super) y: [f32; 2],
    /// The least `low`.
    pub(super) low: f32,
    /// The greatest `near_high` and the least `near_low`.
    pub(super) near: f32,
    pub(super) least_near: f32,
}

impl Bounds {
    /// The bounds of x and y.
    #[inline(always)]
    pub(super) fn in_all_lanes<S: Lanes>(&self, simd: S) -> ([f32x8<S>; 2], [f32x8<S>; 2]) {
        let all = |[a, b]: [f32; 2]| [f32x8::splat(simd, a), f32x8::splat(simd, b)];
        (all(self.x), all(self.y))
    }
}

impl Set {
    pub(super) const EMPTY: Self = {
        let none = [[f32::INFINITY; 8], [f32::NEG_INFINITY; 8]];
        Self { x: none, y: none, low: [f32::INFINITY; 8] }
    };

    /// Makes the bounds of all eight lanes one lane of `above`.
    #[inline(always)]
    fn bound<S: Lanes>(&self, simd: S, above: &mut Self, lane: usize) {
        let load = |numbers: &[f32; 8]| f32x8::load_array_ref(simd, numbers);
        above.x[0][lane] = load(&self.x[0]).reduce_min();
        above.x[1][lane] = load(&self.x[1]).reduce_max();
        above.y[0][lane] = load(&self.y[0]).reduce_min();
        above.y[1][lane] = load(&self.y[1]).reduce_max();
        above.low[lane] = load(&self.low).reduce_min();
    }
}

impl PacketRays {
    pub(super) const EMPTY: Self = Self {
        x: [[0.0; 8]; MOST_VECTORS],
        y: [[0.0; 8]; MOST_VECTORS],
        near_low: [[0.0; 8]; MOST_VECTORS],
        near_high: [[0.0; 8]; MOST_VECTORS],
        low: [[f32::INFINITY; 8]; MOST_VECTORS],
        high: [[f32::INFINITY; 8]; MOST_VECTORS],
        slot: [[NONE; 8]; MOST_VECTORS],
        sets: [Set::EMPTY; MOST_SETS],
        tops: Set::EMPTY,
        set_count: 0,
    };

    /// Finds the bounds of the sets, then those of all rays; those at the near end are not known from
    /// them.
    #[inline(always)]
    pub(super) fn bound<S: Lanes>(&mut self, simd: S) -> Bounds {
        self.tops = Set::EMPTY;
        for (index, set) in self.sets[..self.set_count].iter().enumerate() {
            set.bound(simd, &mut self.tops, index);
        }
        let mut all = Set::EMPTY;
        self.tops.bound(simd, &mut all, 0);
        Bounds {
            x: [all.x[0][0], all.x[1][0]],
            y: [all.y[0][0], all.y[1][0]],
            low: all.low[0],
            near: f32::INFINITY,
            least_near: f32::NEG_INFINITY,
        }
    }

    /// How far the farthest open part reaches.
    #[inline(always)]
    pub(super) fn least_low<S: Lanes>(&self, simd: S) -> f32 {
        f32x8::load_array_ref(simd, &self.tops.low).reduce_min()
    }

    /// Finds how far the open parts of all sets reach, anew.
    #[inline(always)]
    pub(super) fn shorten_sets<S: Lanes>(&mut self, simd: S) {
        for (low, set) in self.tops.low.iter_mut().zip(&self.sets[..self.set_count]) {
            *low = f32x8::load_array_ref(simd, &set.low).reduce_min();
        }
    }

    /// Finds how far the open parts of a vector reach, anew.
    #[inline(always)]
    pub(super) fn shorten<S: Lanes>(&mut self, simd: S, vector: usize) {
        let low = f32x8::load_array_ref(simd, &self.low[vector % MOST_VECTORS]);
        self.sets[vector / 8 % MOST_SETS].low[vector % 8] = low.reduce_min();
    }
}

/// Which lanes a mask has, as bits.
#[inline(always)]
pub(super) fn bits<S: Lanes>(mask: mask32x8<S>) -> u32 {
    mask.to_bitmask() as u32
}
