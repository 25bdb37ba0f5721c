//! A ray's line, moved and scaled to where f32 is sharp.

use crate::geometry::{Ray, power_of_two_below};

/// Directions whose largest component is from the first to the second can be scaled without loss.
const SIZES: std::ops::Range<f64> = 1e-290..1e290;

/// Rays that start farther away than this many times the reach are not moved into it: the error of
/// moving would be that of another rounding to f32.
pub(super) const FARTHEST: f64 = (1_u64 << 20) as f64;

/// What stands in the way of a kernel.
#[derive(Clone, Copy, Debug)]
pub(crate) enum NoAim {
    /// Nothing: the ray surely misses the tree, or no ray can be traced.
    Missed,
    /// The ray's numbers are out of the kernels' range.
    OutOfRange,
}

/// A line that starts within the reach.
pub(super) struct Line {
    pub(super) origin: [f64; 3],
    pub(super) direction: [f64; 3],
    /// Its t is `scale · t − shift`.
    pub(super) scale: f64,
    pub(super) shift: f64,
    /// How far the origin may be off.
    pub(super) moving: f64,
}

impl Line {
    /// The line of a ray that starts beyond the reach, is very long or very short, or is none; its origin
    /// is as the tree sees it.
    #[cold]
    #[inline(never)]
    pub(super) fn in_reach(reach: f64, ray: &Ray<3>, origin: [f64; 3]) -> Result<Self, NoAim> {
        if ray.check().is_err() {
            return Err(NoAim::Missed);
        }
        let size = |v: &[f64; 3]| v.iter().fold(0.0, |most, x| larger(most, x.abs()));
        let (longest, farthest) = (size(&ray.direction), size(&origin));
        if !SIZES.contains(&longest) || farthest > reach * FARTHEST {
            return Err(NoAim::OutOfRange);
        }
        let scale = power_of_two_below(longest);
        let direction = ray.direction.map(|d| d * (1.0 / scale));
        if farthest <= reach {
            return Ok(Self { origin, direction, scale, shift: 0.0, moving: 0.0 });
        }
        let shift = entry(reach, &origin, &direction).ok_or(NoAim::Missed)?;
        let origin = std::array::from_fn(|k| origin[k] + shift * direction[k]);
        let moving = 2.0 * f64::EPSILON * (farthest + 2.0 * shift.abs());
        Ok(Self { origin, direction, scale, shift, moving })
    }

    /// The line in a tree that is larger than the mesh by a power of two.
    #[inline(always)]
    pub(super) fn scaled(self, scale: f64) -> Result<Self, NoAim> {
        let scale = self.scale * scale;
        if scale.is_normal() { Ok(Self { scale, ..self }) } else { Err(NoAim::OutOfRange) }
    }
}

/// The larger of two numbers, if none is NaN.
#[inline(always)]
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Where the line of a ray enters the cube of `reach` around zero; `None` if it passes by. The mesh
/// lies so far inside the cube that rounding does not matter.
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
