//! A packet's rays become points.

use super::projection::{Frame, Projection};
use super::rays::{Bounds, MOST_SETS, MOST_VECTORS, NONE, PacketRays, bits};
use crate::geometry::{Common, RayPacket};
use crate::simd::Lanes;
use crate::traverse::wide::rounding::F32_SLACK;
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, f64x4, mask32x8, u32x8};

/// Directions shorter or longer than this along their main axis do not take part.
pub(super) const SIZES: [f32; 2] = [1.0 / (1_u64 << 40) as f32, (1_u64 << 40) as f32];

/// Coordinates in which the rays of a packet differ, relative to its centre: u, v and k.
pub(super) type Local = [[[f32; 8]; MOST_VECTORS]; 3];

/// How far 1 − t may be off: a reported t may be off by 2^-39.
const TARGET_ERROR: f64 = 1.0 / (1_u64 << 37) as f64;

/// So near the target, by the length of the ray, the filter is not to be sure of hits: a direction is
/// rounded, so that rays pass the target at up to 2^-52 of their length.
const NEAR_TARGET: f64 = 1.0 / (1 << 24) as f64;

/// A part that begins nearer to the target begins at it, as far as bounds go: where rays pass the target counts there.
const AT_TARGET: f64 = 1.0 / (1 << 30) as f64;

/// Where the open parts of eight rays begin and end, counted from the packet's centre in units of their
/// directions: not above and not below.
#[derive(Clone, Copy)]
pub(super) struct Ends<S: Lanes> {
    pub(super) begin: [f32x8<S>; 2],
    pub(super) end: [f32x8<S>; 2],
}

/// Eight rays as points.
pub(super) struct Points<S: Lanes> {
    pub(super) x: f32x8<S>,
    pub(super) y: f32x8<S>,
    /// w at the near end: not above and not below.
    pub(super) near: [f32x8<S>; 2],
    /// w at the far end.
    pub(super) far: [f32x8<S>; 2],
    pub(super) fits: mask32x8<S>,
}

/// Finds the coordinates of `count` rays from `first` on: of their origins, relative to `center`, or for a
/// common origin of their directions. The sum of all, and the largest.
#[inline(always)]
pub(super) fn locals<S: Lanes>(
    simd: S,
    packet: &RayPacket<'_>,
    (first, count): (usize, usize),
    center: [f64; 3],
    local: &mut Local,
) -> ([f64; 3], f32) {
    let center = match packet.common() {
        Common::Origin(_) => [0.0; 3],
        _ => center,
    };
    let each = packet.each();
    let largest = f32x8::splat(simd, f32::MAX);
    let zero = f32x8::splat(simd, 0.0);
    let mut toward = [0.0; 3];
    let mut farthest = zero;
    for axis in 0..3 {
        let center = f64x4::splat(simd, center[axis]);
        let mut sum = zero;
        let numbers = each[axis][first..first + count].chunks(8);
        for (row, numbers) in local[axis].iter_mut().zip(numbers) {
            let [low, high] = load_eight(simd, numbers);
            let numbers = (low - center).narrow(high - center);
            let finite = numbers.abs().simd_le(largest).select(numbers, zero);
            sum += finite;
            farthest = farthest.max(finite.abs());
            *row = *numbers.as_array();
        }
        toward[axis] = f64::from(sum.reduce_sum());
    }
    (toward, farthest.reduce_max())
}

/// Eight numbers; if there are fewer, the last one stands for the others too.
#[inline(always)]
fn load_eight<S: Lanes>(simd: S, numbers: &[f64]) -> [f64x4<S>; 2] {
    if numbers.len() == 8 {
        return [f64x4::from_slice(simd, &numbers[..4]), f64x4::from_slice(simd, &numbers[4..])];
    }
    let mut eight = [numbers[numbers.len() - 1]; 8];
    eight[..numbers.len()].copy_from_slice(numbers);
    [f64x4::from_slice(simd, &eight[..4]), f64x4::from_slice(simd, &eight[4..])]
}

/// Where the open parts of eight rays begin and end.
#[inline(always)]
fn ends<S: Lanes>(simd: S, packet: &RayPacket<'_>, index: usize) -> Ends<S> {
    let is_reversed = matches!(packet.common(), Common::Target(_));
    let ends = |t_min: f64, t_max: f64| {
        if is_reversed {
            let (begin, end) = (1.0 - t_max, 1.0 - t_min);
            // Rays that go on behind the target begin below zero, and do not take part.
            let surely_begun =
                if begin < 0.0 { begin } else { begin.max(NEAR_TARGET) + TARGET_ERROR };
            // An infinite end is not off.
            let off = if end.is_finite() { TARGET_ERROR * (1.0 + end.abs()) } else { 0.0 };
            let begun = if begin < AT_TARGET { begin.min(0.0) } else { begin };
            [begun - TARGET_ERROR, surely_begun, end - off, end + off]
        } else {
            [t_min, t_min, t_max, t_max]
        }
    };
    if let Some(interval) = packet.same_interval() {
        let [a, b, c, d] = ends(interval.t_min, interval.t_max);
        let all = |t: f64| f32x8::splat(simd, t as f32);
        return Ends { begin: [all(a), all(b)], end: [all(c), all(d)] };
    }
    let mut numbers = [[0.0_f32; 8]; 4];
    for lane in 0..8 {
        let interval = packet.interval((index + lane).min(packet.len() - 1));
        let ends = ends(interval.t_min, interval.t_max);
        for (row, t) in numbers.iter_mut().zip(ends) {
            row[lane] = t as f32;
        }
    }
    let load = |row: usize| f32x8::load_array_ref(simd, &numbers[row]);
    Ends { begin: [load(0), load(1)], end: [load(2), load(3)] }
}

/// Makes points of `count` rays from `first` on, of which `local` has the coordinates, and finds
/// their bounds; adds those that do not fit to `left`.
#[inline(always)]
pub(super) fn place<S: Lanes, P: Projection>(
    simd: S,
    packet: &RayPacket<'_>,
    (first, count): (usize, usize),
    (projection, frame): (&P, &Frame),
    local: &Local,
    rays: &mut PacketRays,
    left: &mut Vec<u32>,
) -> Bounds {
    let (none, zero) = (f32x8::splat(simd, f32::INFINITY), f32x8::splat(simd, 0.0));
    let vectors = count.div_ceil(8);
    rays.set_count = vectors.div_ceil(8);
    let (mut near, mut least_near) = (-none, none);
    for vector in 0..vectors {
        let vector = vector % MOST_VECTORS;
        let load = |i: usize| f32x8::load_array_ref(simd, &local[frame.axes[i] % 3][vector]);
        let (u, v, k) = (load(0), load(1), load(2));
        let ends = ends(simd, packet, first + 8 * vector);
        let points = projection.points(simd, [u, v, k * frame.sign], &ends);
        let present = lanes_below(simd, count - 8 * vector);
        let fits = points.fits & points.far[0].simd_lt(f32::INFINITY);
        let missing = bits(present) & !bits(fits);
        let fits = fits & present;
        if missing != 0 {
            leave(missing, first + 8 * vector, left);
        }
        let low = fits.select(points.far[0], none);
        rays.slot[vector] = [NONE; 8];
        rays.x[vector] = *fits.select(points.x, zero).as_array();
        rays.y[vector] = *fits.select(points.y, zero).as_array();
        rays.near_low[vector] = *points.near[0].as_array();
        rays.near_high[vector] = *points.near[1].as_array();
        rays.low[vector] = *low.as_array();
        rays.high[vector] = *fits.select(points.far[1], none).as_array();
        near = near.max(fits.select(points.near[1], -none));
        least_near = least_near.min(fits.select(points.near[0], none));
        let set = &mut rays.sets[vector / 8 % MOST_SETS];
        set.x[0][vector % 8] = fits.select(points.x, none).reduce_min();
        set.x[1][vector % 8] = fits.select(points.x, -none).reduce_max();
        set.y[0][vector % 8] = fits.select(points.y, none).reduce_min();
        set.y[1][vector % 8] = fits.select(points.y, -none).reduce_max();
        set.low[vector % 8] = low.reduce_min();
    }
    // The last set may have fewer vectors.
    for vector in vectors..8 * rays.set_count {
        rays.low[vector % MOST_VECTORS] = [f32::INFINITY; 8];
        let set = &mut rays.sets[vector / 8 % MOST_SETS];
        for bounds in [&mut set.x, &mut set.y] {
            (bounds[0][vector % 8], bounds[1][vector % 8]) = (f32::INFINITY, f32::NEG_INFINITY);
        }
        set.low[vector % 8] = f32::INFINITY;
    }
    let (near, least_near) = (near.reduce_max(), least_near.reduce_min());
    Bounds { near, least_near, ..rays.bound(simd) }
}

/// Adds rays to those that are left.
#[inline(always)]
fn leave(mut missing: u32, first: usize, left: &mut Vec<u32>) {
    while missing != 0 {
        left.push((first + missing.trailing_zeros() as usize) as u32);
        missing &= missing - 1;
    }
}

#[inline(always)]
fn lanes_below<S: Lanes>(simd: S, count: usize) -> mask32x8<S> {
    let lanes = u32x8::load_array(simd, [0, 1, 2, 3, 4, 5, 6, 7]);
    lanes.simd_lt(count.min(8) as u32)
}

/// Whether components along the main axis are of a size to divide by.
#[inline(always)]
pub(super) fn is_main<S: Lanes>(size: f32x8<S>) -> mask32x8<S> {
    size.simd_gt(SIZES[0]) & size.simd_lt(SIZES[1])
}

/// Numbers a little below and a little above.
#[inline(always)]
pub(super) fn around<S: Lanes>(x: f32x8<S>, y: f32x8<S>) -> [f32x8<S>; 2] {
    const SLACK: f32 = 4.0 * F32_SLACK as f32;
    [x * (1.0 - SLACK), y * (1.0 + SLACK)]
}

/// Sums of numbers of that size in all, a little below and a little above.
#[inline(always)]
pub(super) fn around_sum<S: Lanes>(low: f32x8<S>, high: f32x8<S>, size: f32x8<S>) -> [f32x8<S>; 2] {
    let off = size * (4.0 * F32_SLACK as f32);
    [low - off, high + off]
}
