//! The bounding frustum, and which nodes it meets (S12).

use super::projection::Frame;
use crate::layout::WideNode;
use crate::simd::Lanes;
use crate::traverse::wide::rounding::ROUNDING;
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, mask32x8};

/// A side: on one of the axes u and v the rays lie above, or below, base + slope · z.
#[derive(Clone, Copy)]
struct Side<S: Lanes> {
    slope: f32x8<S>,
    base: f32x8<S>,
    /// Whether the side is farthest out at a box's far end.
    at_far: mask32x8<S>,
}

/// The frustum that bounds a packet: four sides, and the z between which rays are open.
pub(super) struct Frustum<S: Lanes> {
    axes: [usize; 3],
    /// Which plane of a box on axis k is its near one.
    near_row: usize,
    sign: f32x8<S>,
    /// What is added to a near plane and to a far one to make z of them, margins included.
    near_shift: f32x8<S>,
    far_shift: f32x8<S>,
    z_near: f32x8<S>,
    /// Lower and upper side, on u and on v.
    sides: [[Side<S>; 2]; 2],
}

/// Bounds of rays on u or v: they lie between `base[0] + slope[0] · z` and `base[1] + slope[1] · z`.
#[derive(Clone, Copy)]
pub(super) struct Span {
    pub(super) slope: [f32; 2],
    pub(super) base: [f32; 2],
}

impl<S: Lanes> Frustum<S> {
    /// The frustum of rays within the spans on u and v, from `z_near` on.
    ///
    /// Margins: all planes, and where rays cross z = 0, lie within `reach` R. With u half the distance
    /// from 1 to the next f32 and C the largest coordinate of the centre, a plane's z is off by
    /// 2 u (R + C) + u C at most, and so is a side's place, but for a relative 5 u of slope · z and for
    /// 3 u R of a base. So planes are moved outward by 8 u (R + C), and slopes by a relative 8 u.
    /// Where z is below zero, as only along a common direction, the latter moves them inward, by less than the former leaves.
    #[inline(always)]
    pub(super) fn new(simd: S, frame: &Frame, reach: f32, spans: [Span; 2], z_near: f32) -> Self {
        let all = |x: f32| f32x8::splat(simd, x);
        let margin = 8.0 * ROUNDING * (reach + frame.distance());
        let side = |axis: usize, upper: usize| {
            let outward = if upper == 1 { 1.0 } else { -1.0 };
            let Span { slope, base } = spans[axis];
            let slope = slope[upper] + outward * (8.0 * ROUNDING) * slope[upper].abs();
            let base = base[upper] + frame.center[axis] + outward * margin;
            let at_far = mask32x8::splat(simd, (slope >= 0.0) == (upper == 1));
            Side { slope: all(slope), base: all(base), at_far }
        };
        let shift = -frame.center[2];
        Self {
            axes: frame.axes,
            near_row: usize::from(frame.sign < 0.0),
            sign: all(frame.sign),
            near_shift: all(shift - margin),
            far_shift: all(shift + margin),
            z_near: all(z_near),
            sides: [[side(0, 0), side(0, 1)], [side(1, 0), side(1, 1)]],
        }
    }

    /// Where the packet may enter the boxes of a node's children, and which of them it may meet with
    /// rays that are open up to `z_far`.
    #[inline(always)]
    pub(super) fn test(&self, simd: S, node: &WideNode, z_far: f32) -> (f32x8<S>, mask32x8<S>) {
        let [u, v, k] = self.axes;
        let load =
            |axis: usize, row: usize| f32x8::load_array_ref(simd, &node.planes(axis % 3)[row & 1]);
        let near = load(k, self.near_row).mul_add(self.sign, self.near_shift).max(self.z_near);
        let far = load(k, 1 - self.near_row).mul_add(self.sign, self.far_shift).min(z_far);
        let mut met = near.simd_le(far);
        for (axis, [lower, upper]) in [u, v].into_iter().zip(&self.sides) {
            let top = upper.at_far.select(far, near);
            met &= load(axis, 0).simd_le(top.mul_add(upper.slope, upper.base));
            let bottom = lower.at_far.select(far, near);
            met &= load(axis, 1).simd_ge(bottom.mul_add(lower.slope, lower.base));
        }
        (near, met)
    }
}
