//! Numbers as people read them.

use std::fmt::{Debug, Display};

/// A number of things, in the right form.
pub(crate) fn counted<N: Display + PartialEq + From<u8>>(
    count: N,
    one: &str,
    many: &str,
) -> String {
    let name = if count == N::from(1) { one } else { many };
    format!("{count} {name}")
}

/// A finite number that was given, in the fewest digits that tell it from its neighbours: of f32
/// fewer than of f64.
pub(crate) fn exact(value: impl Debug) -> String {
    let text = format!("{value:?}");
    let text = text.strip_suffix(".0").unwrap_or(&text);
    if text == "-0" { "0".into() } else { text.into() }
}

/// A number that was computed, for people: six significant digits at most, no trailing zeros, `∞`
/// and `–` for what is not a number.
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
    without_zeros(&text)
}

/// A multiple of `step` on a scale: as many digits as tell it from the next one.
pub(crate) fn tick(value: f64, step: f64) -> String {
    let magnitude = |x: f64| if x == 0.0 { 0.0 } else { x.abs().log10().floor() };
    let last = magnitude(step);
    if value.abs() < 1e7 && (value.abs() >= 1e-4 || last >= -9.0) {
        let decimals = (-last).max(0.0) as usize;
        return without_zeros(&format!("{value:.decimals$}"));
    }
    let digits = (magnitude(value) - last).clamp(0.0, 17.0) as usize;
    let text = format!("{value:.digits$e}");
    match text.split_once('e') {
        Some((number, exponent)) if exponent != "0" => {
            format!("{}e{exponent}", without_zeros(number))
        }
        _ => without_zeros(text.trim_end_matches("e0")),
    }
}

/// A decimal number without the zeros at its end, and without a sign if it is zero.
fn without_zeros(text: &str) -> String {
    let text =
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text };
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
    fn given_numbers_are_exact() {
        assert_eq!([exact(690_194.56_f32), exact(0.1_f32)], ["690194.56", "0.1"].map(String::from));
        assert_eq!([exact(-4.0), exact(1e300), exact(-0.0)], ["-4", "1e300", "0"]);
    }

    #[test]
    fn ticks_differ_from_their_neighbours() {
        for (value, step, text) in [
            (499_999.8, 0.2, "499999.8"),
            (0.6000000000000001, 0.2, "0.6"),
            (1.0, 0.2, "1"),
            (-0.0, 0.2, "0"),
            (40.0, 20.0, "40"),
            (12_345_678.0, 1.0, "1.2345678e7"),
            (3e-12, 1e-12, "3e-12"),
            (0.45, 5e-11, "0.45"),
            (0.44999999995, 5e-11, "0.44999999995"),
            (0.0, 1e-12, "0"),
            (2e30, 1e30, "2e30"),
            (1.0 + 3e-12, 1e-12, "1.000000000003"),
        ] {
            assert_eq!(tick(value, step), text);
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
