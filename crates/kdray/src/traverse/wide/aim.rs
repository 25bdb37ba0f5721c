//! A ray as the kernels see it.

use super::block::{EDGE_ERROR, T_ERROR};
use super::line::{Line, NoAim, larger};
use super::rounding::{F32_SLACK, HIT_ERROR, ROUNDING};
use crate::geometry::{Coordinate, Ray};
use crate::layout::WideTree;
use crate::simd::Lanes;
use fearless_simd::prelude::*;
use fearless_simd::{f32x4, f64x4};

/// Directions whose largest component is from the inverse of this to this are taken as they are.
const LARGEST_COMPONENT: f64 = (1 << 16) as f64;

/// What a direction's component counts as at least where it is divided by: 2^-40 of the least that the
/// largest component may be.
const LEAST_COMPONENT: f32 = 1.0 / (1_u64 << 56) as f32;

/// What M counts as at least in error bounds, 2^-90. From nearer to a corner, or for a t as near to zero, numbers lose
/// 2^-150 to underflow, which m and n and a direction of up to 2^18 are multiplied by; and so do the bounds themselves.
const LEAST_DISTANCE: f64 = 1.0 / (1_u128 << 90) as f64;

/// A ray in f32: the direction scaled by a power of two if it is very long or very short, the origin
/// moved along the ray into the tree's reach if it is far away. Fourth components mean nothing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aim {
    pub(super) origin: [f32; 4],
    pub(super) direction: [f32; 4],
    /// 1 / direction.
    pub(super) inverse: [f32; 4],
    /// origin / direction.
    pub(super) start: [f32; 4],
    /// Which components of the direction are negative: bit k for component k.
    pub(super) octant: usize,
    /// Where the part of the ray that is still open begins and ends, in the kernels' t: not above
    /// and not below the true ones.
    pub(super) t_near: f32,
    pub(super) t_far: f32,
    /// What the errors of a block's edge functions are a unit of ē·(ē + M), and that of T − t·den a
    /// unit of m·n: for a t of one, for t_near, for t_far. See [`super::block`].
    pub(super) edge_rate: f32,
    pub(super) t_rate: f32,
    pub(super) near_rate: f32,
    pub(super) far_rate: f32,
    /// 2^-16 of the way by which the origin was moved.
    blur: f32,
    /// What the distance from the origin counts as at least in error bounds, because the true
    /// origin is not an f32: 2^23 times the difference; and because of underflow.
    pub(super) least_distance: f32,
    /// The kernels' t is `scale · t − shift`.
    scale: f64,
    shift: f64,
}

impl Aim {
    /// At nothing.
    pub(super) const NONE: Self = Self {
        origin: [0.0; 4],
        direction: [0.0; 4],
        inverse: [0.0; 4],
        start: [0.0; 4],
        octant: 0,
        t_near: 0.0,
        t_far: 0.0,
        edge_rate: 0.0,
        t_rate: 0.0,
        near_rate: 0.0,
        far_rate: 0.0,
        blur: 0.0,
        least_distance: 0.0,
        scale: 0.0,
        shift: 0.0,
    };

    /// Prepares a ray. In place: to return an aim costs more than to make one.
    #[inline(always)]
    pub(super) fn set<S: Lanes, T: Coordinate>(
        &mut self,
        simd: S,
        tree: &WideTree,
        ray: &Ray<3>,
    ) -> Result<(), NoAim> {
        simd.step(
            #[inline(always)]
            || self.set_ray::<S, T>(simd, tree, ray),
        )
    }

    #[inline(always)]
    fn set_ray<S: Lanes, T: Coordinate>(
        &mut self,
        simd: S,
        tree: &WideTree,
        ray: &Ray<3>,
    ) -> Result<(), NoAim> {
        let reach = f64::from(tree.reach());
        // In a space of its own the tree is larger, and t with it, so that the direction stays.
        let (origin, scale) = if T::FITS_TREE {
            (ray.origin, 1.0)
        } else {
            (tree.space().point(ray.origin), tree.space().scale())
        };
        let direction = ray.direction;
        if !is_plain(simd, reach, &origin, &direction) {
            let line = Line::in_reach(reach, ray, origin)?.scaled(scale)?;
            return self.set_line(simd, ray, &line, reach);
        }
        let line = Line { origin, direction, scale, shift: 0.0, moving: 0.0 };
        self.set_line(simd, ray, &line, reach)
    }

    /// From the ray's interval and its line, whose largest component is from 2^-16 to 2^16.
    #[inline(always)]
    fn set_line<S: Lanes>(
        &mut self,
        simd: S,
        ray: &Ray<3>,
        line: &Line,
        reach: f64,
    ) -> Result<(), NoAim> {
        // Beyond this the ray has left the reach, and with it the tree, on its largest axis. Finite,
        // so that no product with it is NaN.
        let t_end = reach * (2.5 * LARGEST_COMPONENT);
        let &Line { scale, shift, moving, .. } = line;
        // A hit has a finite t, which in the tree's coordinates is less than any.
        let t_min = ray.interval.t_min.max(f64::MIN) * scale;
        let t_max = ray.interval.t_max.min(f64::MAX) * scale;
        // Of the ray's own numbers: what is smaller may vanish.
        let is_open = ray.interval.t_min <= ray.interval.t_max
            && t_min < f64::INFINITY
            && t_max > f64::NEG_INFINITY;
        let slack = |t: f64| (t.abs() + shift.abs()) * HIT_ERROR;
        let t_near = larger(t_min - shift - slack(t_min), -t_end);
        let t_far = -larger(shift - t_max - slack(t_max), -t_end);
        if !is_open || t_near > t_far {
            return Err(NoAim::Missed);
        }

        let (exact_origin, exact_direction) =
            (load(simd, &line.origin), load(simd, &line.direction));
        let (origin, direction) = simd.split_f32x8(exact_origin.narrow(exact_direction));
        let (rounded, _) = simd.combine_f32x4(origin, direction).widen();
        let off = largest((exact_origin - rounded).abs().as_array());
        let size = direction.abs();
        let divisor = size.max(f32x4::splat(simd, LEAST_COMPONENT)).copysign(direction);
        let inverse = f32x4::splat(simd, 1.0) / divisor;
        self.origin = origin.to_array();
        self.direction = direction.to_array();
        self.inverse = inverse.to_array();
        self.start = (origin * inverse).to_array();
        self.octant = (inverse.simd_lt(0.0).to_bitmask() & 7) as usize;
        let [x, y, z, _] = size.to_array();
        let length = x + y + z;
        (self.edge_rate, self.t_rate) = (EDGE_ERROR * length, T_ERROR * length);
        self.blur = (shift.abs() * (1.0 / (1 << 16) as f64)) as f32;
        let least_distance = (off + moving) * (0.5 / f64::from(ROUNDING));
        self.least_distance = larger(least_distance, LEAST_DISTANCE) as f32;
        (self.scale, self.shift) = (scale, shift);
        self.t_near = (t_near - t_near.abs() * F32_SLACK) as f32;
        self.near_rate = self.rate_at(self.t_near);
        self.end((t_far + t_far.abs() * F32_SLACK) as f32);
        Ok(())
    }

    /// Ends the open part of the ray at `t_far`.
    #[inline(always)]
    pub(super) fn end(&mut self, t_far: f32) {
        self.t_far = t_far;
        self.far_rate = self.rate_at(t_far);
    }

    /// What t adds to the error of T − t·den a unit of m·n. Where the origin was moved, the ends of
    /// the interval are less sharp.
    #[inline(always)]
    pub(super) fn rate_at(&self, t: f32) -> f32 {
        self.t_rate * (t.abs() + self.blur)
    }

    /// The kernels' t of a hit, or a little less, and a little more.
    #[inline(always)]
    pub(super) fn kernel_t_around(&self, t: f64) -> (f32, f32) {
        let slack = (self.shift.abs() + t.abs() * self.scale) * HIT_ERROR;
        let t = t * self.scale - self.shift;
        let slack = slack + (t.abs() + slack) * F32_SLACK;
        ((t - slack) as f32, (t + slack) as f32)
    }

    /// The ray's t of a kernel's.
    #[inline(always)]
    pub(super) fn ray_t(&self, kernel_t: f32) -> f64 {
        (f64::from(kernel_t) + self.shift) / self.scale
    }
}

/// Whether a ray can be taken as it is: it starts within the reach, and its direction is neither
/// very long nor very short.
#[inline(always)]
fn is_plain<S: Lanes>(simd: S, reach: f64, origin: &[f64; 3], direction: &[f64; 3]) -> bool {
    let origin = load(simd, origin).abs();
    let direction = load(simd, direction).abs();
    // No comparison with NaN is true.
    origin.simd_le(reach).all_true()
        && direction.simd_le(LARGEST_COMPONENT).all_true()
        && direction.simd_ge(1.0 / LARGEST_COMPONENT).any_true()
}

/// Three numbers and zero.
#[inline(always)]
fn load<S: Lanes>(simd: S, &[x, y, z]: &[f64; 3]) -> f64x4<S> {
    f64x4::load_array(simd, [x, y, z, 0.0])
}

/// The largest of the first three numbers, if none is NaN.
#[inline(always)]
fn largest(&[x, y, z, _]: &[f64; 4]) -> f64 {
    larger(larger(x, y), z)
}
