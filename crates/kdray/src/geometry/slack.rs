//! The error bound of a ray parameter.

use super::Interval;

/// How far, relative to t, the computed parameter of a plane (three roundings in f64) or of a hit
/// (2^-39 at most, see [`crate::primitives::intersect_triangle`]) may be from the exact one, with room to spare.
const RELATIVE_SLACK: f64 = 1.0 / (1u64 << 38) as f64;

/// The same for parameters so small that they have lost digits to underflow.
const ABSOLUTE_SLACK: f64 = f64::MIN_POSITIVE;

/// An interval that holds the exact t of every hit whose computed t lies in `interval`. A bound of
/// zero stays: the signs of hits are exact.
pub(crate) fn widened(Interval { t_min, t_max }: Interval) -> Interval {
    Interval {
        t_min: if t_min == 0.0 { t_min } else { t_below(t_min) },
        t_max: if t_max == 0.0 { t_max } else { t_above(t_max) },
    }
}

/// A bound that the exact t of a computed one is not below. Infinities and NaN stay.
#[inline]
pub(crate) fn t_below(t: f64) -> f64 {
    if t.is_finite() { t - (t.abs() * RELATIVE_SLACK + ABSOLUTE_SLACK) } else { t }
}

/// A bound that the exact t of a computed one is not above. Infinities and NaN stay.
#[inline]
pub(crate) fn t_above(t: f64) -> f64 {
    if t.is_finite() { t + (t.abs() * RELATIVE_SLACK + ABSOLUTE_SLACK) } else { t }
}
