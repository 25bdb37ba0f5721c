//! Rays from a common point.

use super::forms::Forms;
use super::frustum::{Frustum, Span};
use super::prepare::{Ends, Points, around, is_main};
use super::projection::{Frame, Projection, Wide, signed, widened};
use super::rays::Bounds;
use crate::geometry::Ray;
use crate::layout::TriangleBlock;
use crate::simd::Lanes;
use crate::traverse::wide::rounding::{F32_SLACK, ROUNDING, UNDERFLOW};
use crate::traverse::wide::vector::{Vector, cross, difference, largest};
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, f64x4};

/// Rays with greater slopes do not take part.
const STEEPEST: f32 = 4.0;

/// See [`Perspective::forms`].
const EDGE_ERROR: f32 = 80.0 * ROUNDING;
const DEPTH_ERROR: f32 = 16.0 * ROUNDING;
const LEAST_VOLUME: f32 = 1.0 / (1 << 22) as f32;

/// The packet's centre is the point: a camera, a light.
#[derive(Clone, Copy)]
pub(super) struct Perspective {
    pub(super) frame: Frame,
    /// What the distance of triangles counts as at least in error bounds, because rays pass the centre at
    /// up to 2^-24 of that.
    blur: f32,
    /// What it counts as at least where the side is to be known on which the centre lies, because a hit may be
    /// reported before the centre that lies behind it.
    least_distance: f32,
}

/// Rays to a target pass it at up to 2^-52 of their length: 2^24 times that.
const BLUR: f32 = 1.0 / (1 << 28) as f32;

/// The t of a hit at a target may be off by 2^-39, so that T seen from there is off by six times that, by ē² and the
/// length of the ray: less than [`LEAST_VOLUME`] by this.
const TARGET_BLUR: f32 = 1.0 / (1 << 13) as f32;

/// Normals and depths of triangles that are good are above and below this: others lose digits, or are infinite.
const LEAST_NORMAL: f32 = 1.0 / MOST_DEPTH;
const MOST_DEPTH: f32 = (1_u128 << 100) as f32;

impl Perspective {
    /// Of rays that begin at the centre.
    #[inline(always)]
    pub(super) fn of_origin(frame: Frame) -> Self {
        Self { frame, blur: 0.0, least_distance: 0.0 }
    }

    /// Of rays that go to it, from as far away as that.
    #[inline(always)]
    pub(super) fn of_target(frame: Frame, farthest: f32) -> Self {
        Self { frame, blur: farthest * BLUR, least_distance: farthest * TARGET_BLUR }
    }
}

impl Projection for Perspective {
    /// With a', b', c' relative to the centre and e1, e2 the edges at a, the plane through the centre and
    /// the edge ab has the normal p = a' x e1, that through ca q = e2 x a', that through bc
    /// r = n − p − q with n = e1 x e2; a direction d is inside where all three products with it have the
    /// sign of T = n · a'; and w = (n · d) / T for a d that is 1 along k.
    ///
    /// Errors, with u half the distance from 1 to the next f32, ē the largest coordinate of e1 and e2, M
    /// that of a' (and at least u times that of the centre, and the blur), and D = 1 + |x| + |y| at most:
    /// a' is off by 5 u M, of which one is the blur's, e1 and e2 by u ē, so p and q by 2·8 u ē M; n by
    /// 3 u ē²; r by (40 ē M + 7 ē²) u. x and y are off by 4 u of themselves, and a form is rounded three
    /// times: p · d is off by (16 + 2·7) u ē M D, r · d by (40 + 4·7) u ē M D and (7 + 2·7) u ē² D: all by
    /// less than 80 u ē (ē + M) D.
    ///
    /// n and T are made in f64. Where |T| is above 2^-22 ē² M it is good to 2 u, and n / T to 5 u of its
    /// largest coordinate, unless that or n is out of f32's range, or nearly; so w is off by 12 u of that times D.
    #[inline(always)]
    fn forms<S: Lanes>(&self, simd: S, block: &TriangleBlock, bounds: &Bounds) -> Forms<S> {
        let all = |x: f32| f32x8::splat(simd, x);
        let frame = &self.frame;
        let (a, b, c) = (
            frame.corner(simd, block, 0),
            frame.corner(simd, block, 1),
            frame.corner(simd, block, 2),
        );
        let (n, volume) = self.normal_and_volume(a, b, c);
        let (e1, e2, s) = (difference(b, a), difference(c, a), frame.local(a));
        let (p, q) = (cross(s, e1), cross(e2, s));
        let r = difference(difference(n, p), q);
        let inverse = all(1.0) / volume;
        let depth = [n[0] * inverse, n[1] * inverse, n[2] * inverse];
        let present = s[0].simd_eq(s[0]);
        let edges = [signed(p, volume), signed(q, volume), signed(r, volume)];
        let widest = |[low, high]: [f32; 2]| low.abs().max(high.abs());
        let spread = 1.0 + widest(bounds.x) + widest(bounds.y);
        let edge = largest(e1).max(largest(e2));
        let distance = largest(s).max(all(ROUNDING * frame.distance() + self.blur));
        let edge_error =
            (edge * (edge + distance)).mul_add(all(EDGE_ERROR * spread), all(UNDERFLOW));
        let least = edge * edge * distance.max(all(self.least_distance));
        let good = volume.abs().simd_gt(least.mul_add(all(LEAST_VOLUME), all(UNDERFLOW)))
            & largest(n).simd_gt(LEAST_NORMAL)
            & largest(depth).simd_lt(MOST_DEPTH);
        let depth_error = largest(depth) * all(DEPTH_ERROR * spread);
        Forms { edges, depth, edge_error, depth_error, good, present }
    }

    #[inline(always)]
    fn frustum<S: Lanes>(&self, simd: S, reach: f32, bounds: &Bounds) -> Frustum<S> {
        let span = |slope| Span { slope, base: [0.0; 2] };
        let z_near = (1.0 - 8.0 * ROUNDING) / bounds.near;
        Frustum::new(simd, &self.frame, reach, [span(bounds.x), span(bounds.y)], z_near)
    }

    #[inline(always)]
    fn points<S: Lanes>(&self, simd: S, [u, v, k]: [f32x8<S>; 3], ends: &Ends<S>) -> Points<S> {
        let one = f32x8::splat(simd, 1.0);
        let inverse = one / k;
        let zero = f32x8::splat(simd, 0.0);
        // 1 / 0 is infinite: such a ray is open from the centre on.
        let w = |t: f32x8<S>| (one / t.max(zero)) * inverse;
        let steepest = k * STEEPEST;
        Points {
            x: u * inverse,
            y: v * inverse,
            near: around(w(ends.begin[1]), w(ends.begin[0])),
            far: around(w(ends.end[1]), w(ends.end[0])),
            fits: is_main(k)
                & u.abs().simd_le(steepest)
                & v.abs().simd_le(steepest)
                & ends.begin[1].simd_ge(0.0)
                & ends.begin[0].simd_le(ends.end[1]),
        }
    }

    #[inline(always)]
    fn octant(&self, bounds: &Bounds) -> usize {
        let [u, v, k] = self.frame.axes;
        let bit = |is_negative: bool, axis: usize| usize::from(is_negative) << axis;
        bit(bounds.x[0] + bounds.x[1] < 0.0, u)
            | bit(bounds.y[0] + bounds.y[1] < 0.0, v)
            | bit(self.frame.sign < 0.0, k)
    }

    /// Rays to a target that begin farther away pass it at more than the frustum's margins.
    #[inline(always)]
    fn is_within(&self, distance: f32) -> bool {
        self.frame.distance() < distance && self.blur < distance * BLUR
    }

    #[inline(always)]
    fn z_above(&self, w: f32) -> f32 {
        // Finite, so that it does not reach the planes of a place without child.
        ((1.0 + 8.0 * ROUNDING) / w.max(0.0)).min(f32::MAX)
    }

    fn w_around(&self, ray: &Ray<3>, t: f64) -> (f32, f32) {
        let (z, off) = self.frame.z_at(ray, t);
        let (low, high) = (1.0 / (z + off), 1.0 / (z - off).max(0.0));
        // Finite, for others may be hit at the centre too.
        let low = ((low * (1.0 - F32_SLACK)) as f32).min(f32::MAX);
        (low, (high * (1.0 + F32_SLACK)) as f32)
    }
}

impl Perspective {
    /// n and T in f64, rounded to f32.
    #[inline(always)]
    fn normal_and_volume<S: Lanes>(
        &self,
        a: Vector<S>,
        b: Vector<S>,
        c: Vector<S>,
    ) -> (Vector<S>, f32x8<S>) {
        let ([a0, a1], [b0, b1], [c0, c1]) = (widened(a), widened(b), widened(c));
        let (low, high) = (self.half(a0, b0, c0), self.half(a1, b1, c1));
        let narrow = |i: usize| low[i].narrow(high[i]);
        ([narrow(0), narrow(1), narrow(2)], narrow(3))
    }

    /// n and T of four triangles.
    #[inline(always)]
    fn half<S: Lanes>(&self, a: Wide<S>, b: Wide<S>, c: Wide<S>) -> [f64x4<S>; 4] {
        let [ux, uy, uz] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
        let [vx, vy, vz] = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
        let x = uy.mul_sub(vz, uz * vy);
        let y = uz.mul_sub(vx, ux * vz);
        let z = ux.mul_sub(vy, uy * vx);
        let [sx, sy, sz] = self.frame.exact_local(a);
        [x, y, z, x.mul_add(sx, y.mul_add(sy, z * sz))]
    }
}
