//! What floating-point numbers are made of.

/// Half the distance from 1 to the next f32: the most that rounding changes, relatively.
pub(crate) const ROUNDING: f32 = f32::EPSILON / 2.0;

const EXPONENT: u64 = 0x7ff << 52;

/// The largest power of two that a normal number above zero is not below.
#[inline]
pub(crate) fn power_of_two_below(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & EXPONENT)
}

/// The power of two that makes `x` one to two, as far as there is one; 1 for zero.
pub(crate) fn inverse_power_of_two(x: f64) -> f64 {
    // From 2^-1021 on, so that the inverse is finite, too.
    let x = if x > 0.0 { x.max(2.0 * f64::MIN_POSITIVE) } else { 1.0 };
    1.0 / power_of_two_below(x)
}
