//! How rays that share a point or a direction become points of a plane (after the frusta of Reshetov,
//! Soupikov & Hurley 2005, and Wald, Boulos & Shirley 2007).
//!
//! Let k be the axis along which the rays go most, z the way along it, and u, v the two others. Rays from
//! a common origin are the points x = d_u/d_k, y = d_v/d_k, their slopes; rays along a common
//! direction are the points x, y at which they cross z = 0. Either way the plane through the
//! packet's centre and an edge of a triangle (or the plane of all rays that touch the edge) is a line
//! A·x + B·y + C = 0, and so is what tells depth: w = 1/z for a common origin, w = −z for a common
//! direction, which both fall with t. So one kernel serves both: the two projections differ only in how a
//! triangle's lines are found, and how w belongs to t.

use super::forms::Forms;
use super::frustum::Frustum;
use super::prepare::{Ends, Points};
use super::rays::Bounds;
use crate::geometry::Ray;
use crate::layout::TriangleBlock;
use crate::simd::Lanes;
use crate::traverse::wide::rounding::HIT_ERROR;
use crate::traverse::wide::vector::{Vector, flip_sign};
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, f64x4};

/// A projection; see above.
pub(super) trait Projection: Copy {
    /// The lines of eight triangles.
    fn forms<S: Lanes>(&self, simd: S, block: &TriangleBlock, bounds: &Bounds) -> Forms<S>;

    /// The frustum that bounds rays, for nodes within `reach`.
    fn frustum<S: Lanes>(&self, simd: S, reach: f32, bounds: &Bounds) -> Frustum<S>;

    /// Eight rays as points, from their coordinates on u, v and k.
    fn points<S: Lanes>(&self, simd: S, local: [f32x8<S>; 3], ends: &Ends<S>) -> Points<S>;

    /// The octant of directions that the rays go in, or most of them.
    fn octant(&self, bounds: &Bounds) -> usize;

    /// Whether the packet lies within that distance of zero, and its numbers in the range of f32.
    fn is_within(&self, distance: f32) -> bool;

    /// The z of a w, or a little more.
    fn z_above(&self, w: f32) -> f32;

    /// The w of a hit, or a little less, and a little more.
    fn w_around(&self, ray: &Ray<3>, t: f64) -> (f32, f32);
}

/// The axes of a packet, and where it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// u, v and k.
    pub(super) axes: [usize; 3],
    /// z grows with ±coordinate k.
    pub(super) sign: f32,
    /// Where coordinates begin, on u, v and ±k.
    pub(super) exact_center: [f64; 3],
    /// The f32 next to it, and what that leaves.
    pub(super) center: [f32; 3],
    pub(super) rest: [f32; 3],
}

impl Frame {
    /// The frame around a point, for rays that go along `toward`.
    pub(super) fn new(center: [f64; 3], toward: [f64; 3]) -> Self {
        let size = toward.map(f64::abs);
        let k = (1..3).fold(0, |k, i| if size[i] > size[k] { i } else { k });
        let axes = [(k + 1) % 3, (k + 2) % 3, k];
        let sign = if toward[k] < 0.0 { -1.0 } else { 1.0 };
        let exact_center = [center[axes[0]], center[axes[1]], center[k] * f64::from(sign)];
        let center = exact_center.map(|x| x as f32);
        let rest = std::array::from_fn(|i| (exact_center[i] - f64::from(center[i])) as f32);
        Self { axes, sign, exact_center, center, rest }
    }

    /// The largest size of a coordinate of the centre; NaN if one is.
    #[inline(always)]
    pub(super) fn distance(&self) -> f32 {
        let [u, v, k] = self.center;
        u.abs() + v.abs() + k.abs()
    }

    /// The corners at a place of the triangles of a block, on u, v and ±k.
    #[inline(always)]
    pub(super) fn corner<S: Lanes>(
        &self,
        simd: S,
        block: &TriangleBlock,
        place: usize,
    ) -> Vector<S> {
        let load = |i: usize| f32x8::load_array_ref(simd, block.corner(place, self.axes[i] % 3));
        [load(0), load(1), load(2) * self.sign]
    }

    /// Where points are, from the centre.
    #[inline(always)]
    pub(super) fn local<S: Lanes>(&self, p: Vector<S>) -> Vector<S> {
        let ([a, b, c], [d, e, f]) = (self.center, self.rest);
        [(p[0] - a) - d, (p[1] - b) - e, (p[2] - c) - f]
    }

    /// Where points are, from the centre, in f64.
    #[inline(always)]
    pub(super) fn exact_local<S: Lanes>(&self, p: Wide<S>) -> Wide<S> {
        let [u, v, k] = self.exact_center;
        [p[0] - u, p[1] - v, p[2] - k]
    }

    /// The z of a point of a ray, and how far it may be off.
    pub(super) fn z_at(&self, ray: &Ray<3>, t: f64) -> (f64, f64) {
        let (k, sign) = (self.axes[2], f64::from(self.sign));
        let (start, center) = (sign * ray.origin[k], self.exact_center[2]);
        let way = sign * t * ray.direction[k];
        let off = (start.abs() + center.abs()) * f64::EPSILON + way.abs() * HIT_ERROR;
        (start - center + way, off)
    }
}

/// Three coordinates of four points, in f64.
pub(super) type Wide<S> = [f64x4<S>; 3];

/// Eight points as two times four.
#[inline(always)]
pub(super) fn widened<S: Lanes>(p: Vector<S>) -> [Wide<S>; 2] {
    let (x, y, z) = (p[0].widen(), p[1].widen(), p[2].widen());
    [[x.0, y.0, z.0], [x.1, y.1, z.1]]
}

/// With its sign flipped where `sign` is negative.
#[inline(always)]
pub(super) fn signed<S: Lanes>(v: Vector<S>, sign: f32x8<S>) -> Vector<S> {
    [flip_sign(v[0], sign), flip_sign(v[1], sign), flip_sign(v[2], sign)]
}
