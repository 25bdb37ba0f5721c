//! The numbers of a ray in all lanes.

use super::aim::Aim;
use crate::simd::Lanes;
use fearless_simd::f32x8;
use fearless_simd::prelude::*;

/// Three coordinates of eight points, or of one in all lanes.
pub(super) type Vector<S> = [f32x8<S>; 3];

/// What the slab test and the triangle test need of a ray, in all lanes.
#[derive(Clone, Copy)]
pub(crate) struct RayLanes<S: Lanes> {
    pub(super) origin: Vector<S>,
    pub(super) direction: Vector<S>,
    pub(super) inverse: Vector<S>,
    pub(super) start: Vector<S>,
    pub(super) t_near: f32x8<S>,
    pub(super) t_far: f32x8<S>,
    /// What t_near and t_far add to error bounds: see [`Aim::error_at`].
    pub(super) near_error: f32x8<S>,
    pub(super) far_error: f32x8<S>,
}

impl<S: Lanes> RayLanes<S> {
    #[inline(always)]
    pub(super) fn new(simd: S, aim: &Aim, t_far: f32) -> Self {
        let all = |v: [f32; 3]| v.map(|x| f32x8::splat(simd, x));
        Self {
            origin: all(aim.origin),
            direction: all(aim.direction),
            inverse: all(aim.inverse),
            start: all(aim.start),
            t_near: f32x8::splat(simd, aim.t_near),
            t_far: f32x8::splat(simd, t_far),
            near_error: f32x8::splat(simd, aim.error_at(aim.t_near)),
            far_error: f32x8::splat(simd, aim.error_at(t_far)),
        }
    }

    /// Ends the ray at `t_far`.
    #[inline(always)]
    pub(super) fn end(&mut self, simd: S, aim: &Aim, t_far: f32) {
        self.t_far = f32x8::splat(simd, t_far);
        self.far_error = f32x8::splat(simd, aim.error_at(t_far));
    }
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
