//! Numbers as people read them.

use std::fmt::Display;

/// A number of things, in the right form.
pub(crate) fn counted<N: Display + PartialEq + From<u8>>(
    count: N,
    one: &str,
    many: &str,
) -> String {
    let name = if count == N::from(1) { one } else { many };
    format!("{count} {name}")
}

/// A number for people: six significant digits at most, no trailing zeros, `∞` and `–` for what
/// is not a number.
pub(crate) fn readable(value: f64) -> String {
    if value.is_nan() {
        return "–".into();
    }
    if value.is_infinite() {
        return if value > 0.0 { "∞".into() } else { "−∞".into() };
    }
    let magnitude = if value == 0.0 { 0.0 } else { value.abs().log10().floor() };
    if !(-4.0..7.0).contains(&magnitude) {
        return format!("{value:.4e}");
    }
    let decimals = (5.0 - magnitude).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.decimals$}");
    let text =
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".into() } else { text.into() }
}

/// A number in three digits.
pub(crate) fn three_digits(value: f64) -> String {
    let magnitude = if value == 0.0 { 0.0 } else { value.abs().log10().floor() };
    if !(-4.0..7.0).contains(&magnitude) {
        return format!("{value:.1e}");
    }
    let decimals = (2.0 - magnitude).max(0.0) as usize;
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_is_not_many() {
        let found = [0, 1, 2].map(|count| counted(count, "leaf", "leaves"));
        assert_eq!(found, ["0 leaves", "1 leaf", "2 leaves"]);
    }

    #[test]
    fn numbers_are_short_and_true() {
        for (value, text) in [
            (4.000_000_000_01, "4"),
            (-0.0, "0"),
            (0.1 + 0.2, "0.3"),
            (1234.5678, "1234.57"),
            (1_234_567.0, "1234567"),
            (1e-7, "1.0000e-7"),
            (f64::INFINITY, "∞"),
            (f64::NAN, "–"),
        ] {
            assert_eq!(readable(value), text);
        }
    }

    #[test]
    fn values_have_three_digits() {
        for (value, text) in [(0.0, "0.00"), (1234.5, "1234"), (0.012345, "0.0123"), (9.87, "9.87")]
        {
            assert_eq!(three_digits(value), text);
        }
    }
}
