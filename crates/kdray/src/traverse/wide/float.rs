//! Plain floating point: the hits that the filter alone would report.

use super::aim::Aim;
use super::block::BlockTest;
use crate::layout::TriangleBlock;
use crate::primitives::{Hit, Side};
use crate::simd::Lanes;
use fearless_simd::f32x8;
use fearless_simd::prelude::*;

/// A hit as the kernels find it in plain floating point.
#[derive(Clone, Copy)]
pub(super) struct FloatHit {
    pub(super) t: f32,
    pub(super) hit: Hit,
}

impl FloatHit {
    /// The nearest hit in a block, if there is any in the ray's interval.
    #[inline(always)]
    pub(super) fn nearest<S: Lanes>(simd: S, block: &TriangleBlock, aim: &Aim) -> Option<Self> {
        let test = BlockTest::new::<f32, false>(simd, block, aim);
        let hit = test.candidates(aim) & test.den.simd_gt(0.0);
        if hit.to_bitmask() == 0 {
            return None;
        }
        let t = hit.select(test.volume / test.den, f32x8::splat(simd, f32::INFINITY));
        let least = t.reduce_min();
        let lane = t.simd_eq(least).to_bitmask().trailing_zeros() as usize & 7;
        Some(Self::in_lane(block, aim, &test, least, lane))
    }

    #[inline(always)]
    fn in_lane<S: Lanes>(
        block: &TriangleBlock,
        aim: &Aim,
        test: &BlockTest<S>,
        t: f32,
        lane: usize,
    ) -> Self {
        let share = |x: &f32x8<S>| f64::from(x.as_array()[lane] / test.den.as_array()[lane]);
        let (u, v) = (share(&test.u), share(&test.v));
        let w = (1.0 - u - v).max(0.0);
        // The shares of the corners b and c, which stand `turns` places before 1 and 2.
        let (u, v) = match block.turns(lane) {
            // Rounded, they may be more than one together.
            0 => (u, v.min(1.0 - u)),
            1 => (w, u),
            _ => (v, w),
        };
        let side = if test.facing.as_array()[lane] > 0.0 { Side::Front } else { Side::Back };
        let hit = Hit { t: aim.ray_t(t), primitive_id: block.id(lane), u, v, side };
        Self { t, hit }
    }
}
