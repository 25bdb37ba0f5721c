//! The error bound of a ray parameter.

/// How far, relative to t, the computed parameter of a plane (three roundings in f64) or of a hit
/// (2^-39 at most, see [`crate::exact`]) may be from the exact one, with room to spare.
const T_SLACK: f64 = 1.0 / (1u64 << 38) as f64;

/// A bound that the exact t of a computed one is not below.
#[inline]
pub(crate) fn t_below(t: f64) -> f64 {
    if t.is_finite() { t - t.abs() * T_SLACK } else { t }
}

/// A bound that the exact t of a computed one is not above.
#[inline]
pub(crate) fn t_above(t: f64) -> f64 {
    if t.is_finite() { t + t.abs() * T_SLACK } else { t }
}
