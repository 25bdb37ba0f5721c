//! A ray as the kernels see it.

use super::block::{EDGE_ERROR, T_ERROR};
use crate::geometry::{Interval, Ray};
use crate::layout::{PlaneRows, WideTree};

/// Half the distance from 1 to the next f32.
const ROUNDING: f64 = (f32::EPSILON / 2.0) as f64;

/// A direction's component counts as so much of the largest at least, where it is divided by.
const LEAST_COMPONENT: f32 = 1.0 / (1_u64 << 40) as f32;

/// The largest components of directions that can be scaled without loss, as bits.
const SIZES: std::ops::Range<u64> = 1e-290_f64.to_bits()..1e290_f64.to_bits();

/// Rays that start farther away than this many times the reach are not moved into it: the error of
/// moving would be that of another rounding to f32.
const FARTHEST: f64 = (1_u64 << 20) as f64;

/// How far, relative to t, a reported t may be from the true one, with room for the conversion.
const HIT_ERROR: f64 = 1.0 / (1_u64 << 38) as f64;

/// A ray in f32: the direction scaled by a power of two so that its largest component is from 1 to
/// 2, the origin moved along the ray into the tree's reach.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aim {
    pub(super) origin: [f32; 3],
    pub(super) direction: [f32; 3],
    /// 1 / direction.
    pub(super) inverse: [f32; 3],
    /// origin / direction.
    pub(super) start: [f32; 3],
    pub(super) rows: PlaneRows,
    pub(super) octant: usize,
    /// Where the ray begins and ends, in the kernels' t: not above and not below the true ones.
    pub(super) t_near: f32,
    pub(super) t_far: f32,
    /// The errors of a block's edge functions, and of T − t·den a unit of t, that all its triangles
    /// share: see [`super::block`].
    pub(super) edge_error: f32,
    t_error: f32,
    /// What the distance from the origin counts as at least in error bounds, because the true
    /// origin is not an f32: 2^23 times the difference.
    pub(super) least_distance: f32,
    /// The kernels' t is `scale · t − shift`.
    scale: f64,
    shift: f64,
}

/// What stands in the way of a kernel.
#[derive(Clone, Copy, Debug)]
pub(crate) enum NoAim {
    /// Nothing: the ray surely misses the tree, or no ray can be traced.
    Missed,
    /// The ray's numbers are out of the kernels' range.
    OutOfRange,
}

impl Aim {
    /// Prepares a ray.
    #[inline(always)]
    pub(crate) fn new(tree: &WideTree, ray: &Ray<3>) -> Result<Self, NoAim> {
        let reach = f64::from(tree.reach());
        let (largest, farthest) = (size(&ray.direction), size(&ray.origin));
        let is_plain = SIZES.contains(&largest) && farthest <= reach.to_bits();
        if ray.interval.is_empty() {
            return Err(NoAim::Missed);
        }
        if !is_plain {
            return Self::from_afar(reach, ray);
        }
        let scale = power_of_two_below(largest);
        let direction = ray.direction.map(|d| d * (1.0 / scale));
        Self::in_reach(ray.interval, ray.origin, direction, (scale, 0.0), 0.0, reach)
    }

    /// A ray that starts beyond the reach, or that is none.
    #[cold]
    #[inline(never)]
    fn from_afar(reach: f64, ray: &Ray<3>) -> Result<Self, NoAim> {
        if ray.check().is_err() {
            return Err(NoAim::Missed);
        }
        let (largest, farthest) = (size(&ray.direction), f64::from_bits(size(&ray.origin)));
        if !SIZES.contains(&largest) || farthest > reach * FARTHEST {
            return Err(NoAim::OutOfRange);
        }
        let scale = power_of_two_below(largest);
        let direction = ray.direction.map(|d| d * (1.0 / scale));
        let shift = entry(reach, &ray.origin, &direction).ok_or(NoAim::Missed)?;
        let origin = std::array::from_fn(|k| ray.origin[k] + shift * direction[k]);
        let moving = 2.0 * f64::EPSILON * (farthest + 2.0 * shift.abs());
        Self::in_reach(ray.interval, origin, direction, (scale, shift), moving, reach)
    }

    /// From the ray's interval, a point of its line within the reach (moving which there erred by
    /// `moving`), and its direction, scaled.
    #[inline(always)]
    fn in_reach(
        interval: Interval,
        point: [f64; 3],
        direction: [f64; 3],
        (scale, shift): (f64, f64),
        moving: f64,
        reach: f64,
    ) -> Result<Self, NoAim> {
        let origin = point.map(|o| o as f32);
        let off = [0, 1, 2].map(|k| (point[k] - f64::from(origin[k])).abs());
        let error = off[0].max(off[1]).max(off[2]) + moving;
        let direction = direction.map(|d| d as f32);
        let inverse = direction.map(|d| 1.0 / d.abs().max(LEAST_COMPONENT).copysign(d));
        // Beyond this the ray has left the reach, and with it the tree, on its largest axis.
        let t_end = 2.5 * reach;
        let t_slack = (shift.abs() + t_end) * HIT_ERROR;
        let t_near = (interval.t_min * scale - shift).max(-t_end) - t_slack;
        let t_far = (interval.t_max * scale - shift).min(t_end) + t_slack;
        if t_near > t_far {
            return Err(NoAim::Missed);
        }
        let sign = |k: usize| (inverse[k].to_bits() >> 31) as usize;
        let octant = sign(0) | sign(1) << 1 | sign(2) << 2;
        let length = direction[0].abs() + direction[1].abs() + direction[2].abs();
        Ok(Self {
            origin,
            direction,
            inverse,
            start: [0, 1, 2].map(|k| origin[k] * inverse[k]),
            rows: PlaneRows::of_octant(octant),
            octant,
            t_near: (t_near as f32).next_down(),
            t_far: (t_far as f32).next_up(),
            edge_error: EDGE_ERROR * length,
            t_error: T_ERROR * length,
            least_distance: (error / ROUNDING * 0.5) as f32,
            scale,
            shift,
        })
    }

    /// What t adds to the error of T − t·den, a unit of ē².
    #[inline(always)]
    pub(super) fn error_at(&self, t: f32) -> f32 {
        self.t_error * t.abs()
    }

    /// The kernels' t of a hit, or a little more.
    #[inline(always)]
    pub(super) fn kernel_t_above(&self, t: f64) -> f32 {
        let slack = (self.shift.abs() + t.abs() * self.scale) * HIT_ERROR;
        ((t * self.scale - self.shift + slack) as f32).next_up().next_up()
    }

    /// The ray's t of a kernel's.
    #[inline(always)]
    pub(super) fn ray_t(&self, kernel_t: f32) -> f64 {
        (f64::from(kernel_t) + self.shift) / self.scale
    }
}

/// The bits of the largest size of a component. They are in the order of the numbers; NaN and
/// infinity are above all others.
#[inline(always)]
fn size(v: &[f64; 3]) -> u64 {
    let [x, y, z] = v.map(|x| x.abs().to_bits());
    x.max(y).max(z)
}

/// The largest power of two that a normal number of these bits is not below.
#[inline(always)]
fn power_of_two_below(bits: u64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    f64::from_bits(bits & EXPONENT)
}

/// Where the line of a ray enters the cube of `reach` around zero; `None` if it passes by. The mesh
/// lies so far inside the cube that rounding does not matter.
#[cold]
fn entry(reach: f64, origin: &[f64; 3], direction: &[f64; 3]) -> Option<f64> {
    let (mut t_near, mut t_far) = (f64::NEG_INFINITY, f64::INFINITY);
    for (&o, &d) in origin.iter().zip(direction) {
        if d == 0.0 {
            if o.abs() > reach {
                return None;
            }
            continue;
        }
        let (low, high) = ((-reach - o) / d, (reach - o) / d);
        t_near = t_near.max(low.min(high));
        t_far = t_far.min(low.max(high));
    }
    (t_near <= t_far).then_some(t_near)
}
