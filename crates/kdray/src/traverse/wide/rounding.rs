//! What rounding does, and how much is allowed for it.

pub(super) use crate::geometry::ROUNDING;

/// More than what rounding to f32 changes, relatively.
pub(super) const F32_SLACK: f64 = 1.0 / (1 << 22) as f64;

/// How far, relative to t, a reported t may be from the true one, with room for a conversion.
pub(super) const HIT_ERROR: f64 = 1.0 / (1_u64 << 38) as f64;

/// More than underflow takes of an inner product: of three products of a number up to 2^34 and one that has lost
/// some 2^-150 itself.
pub(super) const UNDERFLOW: f32 = f32::MIN_POSITIVE * (1 << 14) as f32;
