//! The sRGB transfer function (IEC 61966-2-1).

/// The linear value of an sRGB value from 0 to 1. NaN stays NaN.
pub(crate) fn to_linear(encoded: f32) -> f32 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}
