//! The way up from a node at which a search began.

use super::aim::Aim;
use crate::layout::Home;
use crate::simd::Lanes;
use fearless_simd::prelude::*;
use fearless_simd::{f32x4, f32x8};

/// The box around a ray's open part: the lower faces in the lanes 0 to 2, the upper ones, negated,
/// in the lanes 4 to 6.
pub(super) struct Span<S: Lanes>(f32x8<S>);

impl<S: Lanes> Span<S> {
    #[inline(always)]
    pub(super) fn new(simd: S, aim: &Aim) -> Self {
        let origin = f32x4::load_array_ref(simd, &aim.origin);
        let direction = f32x4::load_array_ref(simd, &aim.direction);
        let (near, far) = (direction * aim.t_near + origin, direction * aim.t_far + origin);
        Self(simd.combine_f32x4(near.min(far), -near.max(far)))
    }

    /// Whether all that the ray hits is surely listed below a node: its open part lies in the node's
    /// cell, off the faces that the cell shares with others.
    ///
    /// With u half the distance from 1 to the next f32 and R the tree's reach, an end of the part is
    /// o + t·d. The origin is rounded and, where it was moved, off by 2 u R at most; the direction,
    /// the product and the sum are rounded once each. Where the end lies within the reach on an
    /// axis, t·d is at most 2 R there, so that the end is off by 7 u R at most: less than the 12 u R
    /// by which homes are smaller than cells. Where it lies beyond, it is off by 7 u of itself at
    /// most, and so comes out beyond all faces but for 7 u R, as it should.
    #[inline(always)]
    pub(super) fn is_in(&self, simd: S, home: &Home) -> bool {
        const FACES: u64 = 0b0111_0111;
        let inside = self.0.simd_ge(f32x8::load_array_ref(simd, home.faces()));
        inside.to_bitmask() & FACES == FACES
    }
}
