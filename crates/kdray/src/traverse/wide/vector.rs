//! Vectors of three coordinates, eight of them at a time.

use crate::simd::Lanes;
use fearless_simd::f32x8;
use fearless_simd::prelude::*;

/// Three coordinates of eight points, or of one in all lanes.
pub(super) type Vector<S> = [f32x8<S>; 3];

/// One point in all lanes.
#[inline(always)]
pub(super) fn splat<S: Lanes>(simd: S, [x, y, z, _]: &[f32; 4]) -> Vector<S> {
    [f32x8::splat(simd, *x), f32x8::splat(simd, *y), f32x8::splat(simd, *z)]
}

/// a x b.
#[inline(always)]
pub(super) fn cross<S: Lanes>(a: Vector<S>, b: Vector<S>) -> Vector<S> {
    let [ax, ay, az] = a;
    let [bx, by, bz] = b;
    [ay.mul_sub(bz, az * by), az.mul_sub(bx, ax * bz), ax.mul_sub(by, ay * bx)]
}

/// a · b.
#[inline(always)]
pub(super) fn dot<S: Lanes>(a: Vector<S>, b: Vector<S>) -> f32x8<S> {
    let [ax, ay, az] = a;
    let [bx, by, bz] = b;
    ax.mul_add(bx, ay.mul_add(by, az * bz))
}

/// a − b.
#[inline(always)]
pub(super) fn difference<S: Lanes>(a: Vector<S>, b: Vector<S>) -> Vector<S> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The largest size of a component.
#[inline(always)]
pub(super) fn largest<S: Lanes>(v: Vector<S>) -> f32x8<S> {
    v[0].abs().max(v[1].abs()).max(v[2].abs())
}

/// x with its sign flipped where `sign` is negative.
#[inline(always)]
pub(super) fn flip_sign<S: Lanes>(x: f32x8<S>, sign: f32x8<S>) -> f32x8<S> {
    let negative = sign.to_bits() & 0x8000_0000_u32;
    f32x8::from_bits(x.to_bits() ^ negative)
}
