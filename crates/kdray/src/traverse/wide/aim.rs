//! A ray as the kernels see it.

use super::block::{EDGE_ERROR, T_ERROR};
use crate::geometry::{Interval, Ray};
use crate::layout::WideTree;

/// Half the distance from 1 to the next f32.
const ROUNDING: f64 = (f32::EPSILON / 2.0) as f64;

/// Directions whose largest component is from the inverse of this to this are taken as they are.
const LARGEST_COMPONENT: f64 = (1 << 16) as f64;

/// What a direction's component counts as at least where it is divided by: 2^-40 of the largest.
const LEAST_COMPONENT: f32 = 1.0 / (1_u64 << 56) as f32;

/// The largest components of directions that are taken as they are, as bits.
const PLAIN_SIZES: std::ops::Range<u64> =
    (1.0 / LARGEST_COMPONENT).to_bits()..LARGEST_COMPONENT.to_bits();

/// The largest components of directions that can be scaled without loss, as bits.
const SIZES: std::ops::Range<u64> = 1e-290_f64.to_bits()..1e290_f64.to_bits();

/// Rays that start farther away than this many times the reach are not moved into it: the error of
/// moving would be that of another rounding to f32.
const FARTHEST: f64 = (1_u64 << 20) as f64;

/// How far, relative to t, a reported t may be from the true one, with room for the conversion.
const HIT_ERROR: f64 = 1.0 / (1_u64 << 38) as f64;

/// More than what rounding to f32 changes, relatively.
const F32_SLACK: f64 = 1.0 / (1 << 22) as f64;

/// A ray in f32: the direction scaled by a power of two if it is very long or very short, the origin
/// moved along the ray into the tree's reach if it is far away.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aim {
    pub(super) origin: [f32; 3],
    pub(super) direction: [f32; 3],
    /// 1 / direction.
    pub(super) inverse: [f32; 3],
    /// origin / direction.
    pub(super) start: [f32; 3],
    pub(super) octant: usize,
    /// Where the ray begins and ends, in the kernels' t: not above and not below the true ones.
    pub(super) t_near: f32,
    pub(super) t_far: f32,
    /// The errors of a block's edge functions, and of T − t·den a unit of t, that all its triangles
    /// share: see [`super::block`].
    pub(super) edge_error: f32,
    t_error: f32,
    /// 2^-16 of the way by which the origin was moved.
    blur: f32,
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
    /// At nothing.
    pub(super) const NONE: Self = Self {
        origin: [0.0; 3],
        direction: [0.0; 3],
        inverse: [0.0; 3],
        start: [0.0; 3],
        octant: 0,
        t_near: 0.0,
        t_far: 0.0,
        edge_error: 0.0,
        t_error: 0.0,
        blur: 0.0,
        least_distance: 0.0,
        scale: 0.0,
        shift: 0.0,
    };

    /// Prepares a ray. In place: to return an aim costs more than to make one.
    #[inline(always)]
    pub(super) fn set(&mut self, tree: &WideTree, ray: &Ray<3>) -> Result<(), NoAim> {
        let reach = tree.reach();
        let (largest, farthest) = (size(&ray.direction), size(&ray.origin));
        if !PLAIN_SIZES.contains(&largest) || farthest > f64::from(reach).to_bits() {
            return self.set_from_afar(f64::from(reach), ray);
        }
        (self.scale, self.shift) = (1.0, 0.0);
        self.set_in_reach(ray.interval, &ray.origin, &ray.direction, 0.0, f64::from(reach))
    }

    /// A ray that starts beyond the reach, is very long or very short, or is none.
    #[cold]
    #[inline(never)]
    fn set_from_afar(&mut self, reach: f64, ray: &Ray<3>) -> Result<(), NoAim> {
        if ray.check().is_err() {
            return Err(NoAim::Missed);
        }
        let (largest, farthest) = (size(&ray.direction), f64::from_bits(size(&ray.origin)));
        if !SIZES.contains(&largest) || farthest > reach * FARTHEST {
            return Err(NoAim::OutOfRange);
        }
        self.scale = power_of_two_below(largest);
        let direction = ray.direction.map(|d| d * (1.0 / self.scale));
        if farthest <= reach {
            self.shift = 0.0;
            return self.set_in_reach(ray.interval, &ray.origin, &direction, 0.0, reach);
        }
        let shift = entry(reach, &ray.origin, &direction).ok_or(NoAim::Missed)?;
        self.shift = shift;
        let origin = std::array::from_fn(|k| ray.origin[k] + shift * direction[k]);
        let moving = 2.0 * f64::EPSILON * (farthest + 2.0 * shift.abs());
        self.set_in_reach(ray.interval, &origin, &direction, moving, reach)
    }

    /// From the ray's interval, a point of its line within the reach (moving which there erred by
    /// `moving`), and its direction, whose largest component is from 2^-16 to 2^16.
    #[inline(always)]
    fn set_in_reach(
        &mut self,
        interval: Interval,
        point: &[f64; 3],
        direction: &[f64; 3],
        moving: f64,
        reach: f64,
    ) -> Result<(), NoAim> {
        // Beyond this the ray has left the reach, and with it the tree, on its largest axis. Finite,
        // so that no product with it is NaN.
        let t_end = reach * (2.5 * LARGEST_COMPONENT);
        let (t_min, t_max) = (interval.t_min * self.scale, interval.t_max * self.scale);
        let is_open = t_min <= t_max && t_min < f64::INFINITY && t_max > f64::NEG_INFINITY;
        let slack = |t: f64| (t.abs() + self.shift.abs()) * HIT_ERROR;
        let t_near = larger(t_min - self.shift - slack(t_min), -t_end);
        let t_far = -larger(self.shift - t_max - slack(t_max), -t_end);
        if !is_open || t_near > t_far {
            return Err(NoAim::Missed);
        }
        self.t_near = (t_near - t_near.abs() * F32_SLACK) as f32;
        self.t_far = (t_far + t_far.abs() * F32_SLACK) as f32;

        let mut off = 0.0;
        for k in 0..3 {
            self.origin[k] = point[k] as f32;
            off = larger(off, (point[k] - f64::from(self.origin[k])).abs());
            let d = direction[k] as f32;
            self.direction[k] = d;
            let size = if d.abs() > LEAST_COMPONENT { d.abs() } else { LEAST_COMPONENT };
            self.inverse[k] = 1.0 / size.copysign(d);
            self.start[k] = self.origin[k] * self.inverse[k];
        }
        let [x, y, z] = self.direction;
        let sign = |d: f32| (d.to_bits() >> 31) as usize;
        self.octant = sign(x) | sign(y) << 1 | sign(z) << 2;
        let length = x.abs() + y.abs() + z.abs();
        (self.edge_error, self.t_error) = (EDGE_ERROR * length, T_ERROR * length);
        self.blur = (self.shift.abs() * (1.0 / (1 << 16) as f64)) as f32;
        self.least_distance = ((off + moving) * (0.5 / ROUNDING)) as f32;
        Ok(())
    }

    /// What t adds to the error of T − t·den, a unit of ē². Where the origin was moved, the ends of
    /// the interval are less sharp.
    #[inline(always)]
    pub(super) fn error_at(&self, t: f32) -> f32 {
        self.t_error * (t.abs() + self.blur)
    }

    /// The kernels' t of a hit, or a little more.
    #[inline(always)]
    pub(super) fn kernel_t_above(&self, t: f64) -> f32 {
        let slack = (self.shift.abs() + t.abs() * self.scale) * HIT_ERROR;
        let t = t * self.scale - self.shift + slack;
        (t + t.abs() * F32_SLACK) as f32
    }

    /// The ray's t of a kernel's.
    #[inline(always)]
    pub(super) fn ray_t(&self, kernel_t: f32) -> f64 {
        (f64::from(kernel_t) + self.shift) / self.scale
    }
}

/// The larger of two numbers, if none is NaN.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
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
