//! Rays along a common direction.

use super::forms::Forms;
use super::frustum::{Frustum, Span};
use super::prepare::{Ends, Points, SIZES, around_sum};
use super::projection::{Frame, Projection, Wide, signed, widened};
use super::rays::Bounds;
use crate::geometry::Ray;
use crate::layout::TriangleBlock;
use crate::simd::Lanes;
use crate::traverse::wide::rounding::{F32_SLACK, ROUNDING, UNDERFLOW};
use crate::traverse::wide::vector::Vector;
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, f64x4};

/// See [`Parallel::forms`].
const EDGE_ERROR: f32 = 128.0 * ROUNDING;
const DEPTH_ERROR: f32 = 32.0 * ROUNDING;
const SIZE_ERROR: f32 = 4.0 * ROUNDING;
const LEAST_DEN: f32 = 1.0 / (1 << 22) as f32;
/// Coordinates beyond this do not take part.
const FARTHEST: f32 = (1_u64 << 60) as f32;
/// An end of a ray that is as far along z counts as here, which is beyond all that takes part.
const LONGEST: f32 = FARTHEST * (1 << 20) as f32;

/// The packet's centre is the origin of one of its rays.
#[derive(Clone, Copy)]
pub(super) struct Parallel {
    pub(super) frame: Frame,
    /// How far rays move on u and v while z grows by one.
    pub(super) slope: [f32; 2],
    exact_slope: [f64; 2],
    /// The largest coordinate of the rays' origins, from the centre.
    farthest: f32,
    /// How far z grows while t grows by one.
    pub(super) pace: f32,
    /// Which components of the direction are negative.
    pub(super) octant: usize,
}

impl Parallel {
    pub(super) fn new(center: [f64; 3], direction: [f64; 3], farthest: f32) -> Self {
        let frame = Frame::new(center, direction);
        let [u, v, k] = frame.axes;
        let pace = direction[k].abs();
        let exact_slope = [direction[u] / pace, direction[v] / pace];
        let slope = exact_slope.map(|x| x as f32);
        let bit = |axis: usize| usize::from(direction[axis] < 0.0) << axis;
        Self {
            frame,
            slope,
            exact_slope,
            farthest,
            pace: pace as f32,
            octant: bit(0) | bit(1) | bit(2),
        }
    }

    /// A point's place in the plane, from its coordinates on u, v and k.
    #[inline(always)]
    fn project<S: Lanes>(&self, [u, v, k]: Vector<S>) -> [f32x8<S>; 2] {
        let [slope_u, slope_v] = self.slope;
        [u - k * slope_u, v - k * slope_v]
    }
}

impl Parallel {
    /// The forms of ab, ca, bc and of the depth, den, and the largest coordinates of e1 and e2 and of a.
    #[inline(always)]
    fn half<S: Lanes>(&self, simd: S, a: Wide<S>, b: Wide<S>, c: Wide<S>) -> [f64x4<S>; 15] {
        let all = |x: f64| f64x4::splat(simd, x);
        let [ax, ay, az] = self.frame.exact_local(a);
        let (e1x, e1y, e1z) = (b[0] - a[0], b[1] - a[1], b[2] - a[2]);
        let (e2x, e2y, e2z) = (c[0] - a[0], c[1] - a[1], c[2] - a[2]);
        let edge = largest(e1x, e1y, e1z).max(largest(e2x, e2y, e2z));
        let distance = largest(ax, ay, az);
        let [u, v] = self.exact_slope;
        let (u, v) = (all(u), all(v));
        let (ax, ay) = (ax - az * u, ay - az * v);
        let (e1x, e1y) = (e1x - e1z * u, e1y - e1z * v);
        let (e2x, e2y) = (e2x - e2z * u, e2y - e2z * v);
        // e1 x (p − a) and (p − a) x e2, and what is left of den.
        let ab = [-e1y, e1x, e1y * ax - e1x * ay];
        let ca = [e2y, -e2x, e2x * ay - e2y * ax];
        let den = e1x * e2y - e1y * e2x;
        let bc = [-ab[0] - ca[0], -ab[1] - ca[1], den - ab[2] - ca[2]];
        let inverse = all(-1.0) / den;
        let (to_b, to_c) = (e1z * inverse, e2z * inverse);
        // w = −z
        let depth = [
            ca[0] * to_b + ab[0] * to_c,
            ca[1] * to_b + ab[1] * to_c,
            ca[2] * to_b + ab[2] * to_c - az,
        ];
        [
            ab[0], ab[1], ab[2], ca[0], ca[1], ca[2], bc[0], bc[1], bc[2], depth[0], depth[1],
            depth[2], den, edge, distance,
        ]
    }
}

#[inline(always)]
fn largest<S: Lanes>(x: f64x4<S>, y: f64x4<S>, z: f64x4<S>) -> f64x4<S> {
    x.abs().max(y.abs()).max(z.abs())
}

impl Projection for Parallel {
    /// In the plane, a is where the rays' direction through the corner a crosses z = 0, and e1, e2 the
    /// edges there as z grows by their third coordinate. The edge functions are e1 x (p − a) of ab,
    /// (p − a) x e2 of ca, and den − the others of bc, with den = e1 x e2. z is that of a, plus that of
    /// e1 and e2 by the shares of b and c.
    ///
    /// All that is made in f64, whose own errors are far below those of rounding the results. With u half
    /// the distance from 1 to the next f32, ē the largest coordinate of the edges in space, M that of a
    /// from the centre and L that of a ray's origin: x and y are off by 6 u L and at most 2 L; A and B of
    /// ab and ca are at most 2 ē, C at most 8 ē M, of bc twice as much and 8 ē² more; forms are rounded
    /// four times. So they are off by (56 ē (L + M)) u, that of bc by (112 ē (L + M) + 32 ē²) u.
    /// A and B that underflow are off by 2^-150 each, and so the forms by 2^-148 L more.
    ///
    /// Where den is above 2^-22 ē², what f64 loses in the form of w is below 4 u (ē + M + L); the slopes A
    /// and B of w are off by 4 u of themselves and x and y by 6 u L: in all 28 u L times the slope; and
    /// 4 u of C.
    #[inline(always)]
    fn forms<S: Lanes>(&self, simd: S, block: &TriangleBlock, _bounds: &Bounds) -> Forms<S> {
        let all = |x: f32| f32x8::splat(simd, x);
        let corner = |place: usize| widened(self.frame.corner(simd, block, place));
        let ([a0, a1], [b0, b1], [c0, c1]) = (corner(0), corner(1), corner(2));
        let (low, high) = (self.half(simd, a0, b0, c0), self.half(simd, a1, b1, c1));
        let narrow = |i: usize| low[i].narrow(high[i]);
        let (ab, ca) = ([narrow(0), narrow(1), narrow(2)], [narrow(3), narrow(4), narrow(5)]);
        let bc = [narrow(6), narrow(7), narrow(8)];
        let depth = [narrow(9), narrow(10), narrow(11)];
        let den = narrow(12);
        let present = den.simd_eq(den);
        let edges = [signed(ab, den), signed(bc, den), signed(ca, den)];
        let (edge, distance) = (narrow(13), narrow(14));
        let size = edge + distance + self.farthest;
        let underflow = UNDERFLOW + self.farthest * f32::MIN_POSITIVE;
        let edge_error = (edge * size).mul_add(all(EDGE_ERROR), all(underflow));
        let least = (edge * edge).mul_add(all(LEAST_DEN), all(UNDERFLOW));
        let good = den.abs().simd_gt(least);
        let slope = depth[0].abs().max(depth[1].abs());
        let depth_error = (slope * self.farthest + depth[2].abs())
            .mul_add(all(DEPTH_ERROR), size * all(SIZE_ERROR));
        Forms { edges, depth, edge_error, depth_error, good, present }
    }

    #[inline(always)]
    fn frustum<S: Lanes>(&self, simd: S, reach: f32, bounds: &Bounds) -> Frustum<S> {
        let span = |base, slope| Span { slope: [slope; 2], base };
        let [u, v] = self.slope;
        let z_near = -bounds.near;
        let spans = [span(bounds.x, u), span(bounds.y, v)];
        Frustum::new(simd, &self.frame, reach + 2.0 * self.farthest, spans, z_near)
    }

    #[inline(always)]
    fn points<S: Lanes>(&self, simd: S, local: [f32x8<S>; 3], ends: &Ends<S>) -> Points<S> {
        let [x, y] = self.project(local);
        // Not t is bounded, for as t grows by one z may grow by very little.
        let way = |t: f32x8<S>| (t * self.pace).min(f32x8::splat(simd, LONGEST));
        let w = |t: f32x8<S>| -way(t) - local[2];
        let off = |t: f32x8<S>| way(t) + local[2].abs();
        let (a, b) = (ends.begin, ends.end);
        let fits = local[0].abs().simd_lt(FARTHEST)
            & local[1].abs().simd_lt(FARTHEST)
            & local[2].abs().simd_lt(FARTHEST)
            & a[0].simd_ge(0.0)
            & a[0].simd_le(b[1]);
        Points {
            x,
            y,
            near: around_sum(w(a[1]), w(a[0]), off(a[0])),
            far: around_sum(w(b[1]), w(b[0]), off(b[0])),
            fits,
        }
    }

    #[inline(always)]
    fn octant(&self, _bounds: &Bounds) -> usize {
        self.octant
    }

    #[inline(always)]
    fn is_within(&self, distance: f32) -> bool {
        let is_main = self.pace > SIZES[0] && self.pace < SIZES[1];
        is_main && self.farthest < distance && self.frame.distance() < distance
    }

    #[inline(always)]
    fn z_above(&self, w: f32) -> f32 {
        // Finite, so that it does not reach the planes of a place without child.
        (-w).min(f32::MAX)
    }

    fn w_around(&self, ray: &Ray<3>, t: f64) -> (f32, f32) {
        let (z, off) = self.frame.z_at(ray, t);
        let off = off + z.abs() * F32_SLACK;
        ((-z - off) as f32, (off - z) as f32)
    }
}
