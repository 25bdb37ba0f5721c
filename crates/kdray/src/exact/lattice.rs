//! Numbers as integers: the short way to exact signs and values.

use super::accumulator::{Decoded, ShortAccumulator};
use std::cmp::Ordering;

/// As many bits as coordinates may have: their differences have one more, and what the differences of two products
/// of these come to fits 124.
const BITS: i32 = 60;

/// As many as they may have on the long lattice, where their differences have one more.
const LONG_BITS: i32 = 118;

/// How far the mantissa of the largest number is shifted, if it is one of those that have 52 bits.
const MOST_SHIFT: i32 = LONG_BITS - 52;

/// Far from overflow and underflow.
const SIZES: std::ops::Range<f64> = 1e-200..1e200;

/// The numbers times a power of two that they share and that makes all of them integers below 2^60; `None`
/// if there is none, or their size is out of the ordinary.
///
/// Corners in f32, and rays that were made of f32, mostly have one. Where rays are aimed at vertices and along edges,
/// signs are zero, which no rounded arithmetic can tell; integers do, in far fewer steps than an
/// [`Accumulator`](super::Accumulator) of a hundred limbs.
#[inline]
pub(super) fn on_lattice<const N: usize>(numbers: [f64; N]) -> Option<[i64; N]> {
    let largest = numbers.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    if largest == 0.0 {
        return Some([0; N]);
    }
    if !SIZES.contains(&largest) {
        return None;
    }
    let exponent = (largest.to_bits() >> 52) as i32 - 1023;
    let scale = f64::from_bits(((BITS - 1 - exponent + 1023) as u64) << 52);
    let mut integers = [0; N];
    for (integer, x) in integers.iter_mut().zip(numbers) {
        let scaled = x * scale;
        *integer = scaled as i64;
        // What became zero by underflow was not zero.
        if *integer as f64 != scaled || (*integer == 0 && x != 0.0) {
            return None;
        }
    }
    Some(integers)
}

/// Finite numbers as integers below 2^118, and the power of two of their unit; `None` if there is none.
///
/// There is one for f64 of all digits whose exponents are at most 65 apart.
#[inline]
pub(super) fn on_long_lattice<const N: usize>(
    points: [[f64; 3]; N],
) -> Option<([[i128; 3]; N], i32)> {
    let largest = points.as_flattened().iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let unit = (largest.to_bits() >> 52) as i32 - 1023 - (LONG_BITS - 1);
    let mut integers = [[0; 3]; N];
    for (integer, &x) in integers.as_flattened_mut().iter_mut().zip(points.as_flattened()) {
        *integer = in_units(x, unit)?;
    }
    Some((integers, unit))
}

/// The number as a multiple of 2^unit; `None` if it is none, or is 2^119 or more, as only what is not finite can be.
#[inline]
fn in_units(x: f64, unit: i32) -> Option<i128> {
    let Decoded { mantissa, exponent, negative } = Decoded::of(x);
    let shift = exponent - unit;
    let size = if shift > MOST_SHIFT {
        return None;
    } else if shift >= 0 {
        i128::from(mantissa) << shift
    } else if mantissa == 0 {
        0
    } else if mantissa.trailing_zeros() >= shift.unsigned_abs() {
        i128::from(mantissa >> -shift)
    } else {
        return None;
    };
    Some(if negative { -size } else { size })
}

/// The sign of a_i b_j − a_j b_i, of integers below 2^119 in size.
#[inline]
pub(super) fn cross_component_sign(a: [i128; 3], b: [i128; 3], (i, j): (usize, usize)) -> Ordering {
    let mut sum = ShortAccumulator::of_units(0);
    sum.add_integers([a[i], b[j], 1]);
    sum.add_integers([-a[j], b[i], 1]);
    sum.sign()
}

/// The vector between two points.
#[inline]
pub(super) fn minus(a: [i128; 3], b: [i128; 3]) -> [i128; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// x · (y x z), of integers below 2^119 in size, in units of that power of two.
#[inline]
pub(super) fn triple_product(
    x: [i128; 3],
    y: [i128; 3],
    z: [i128; 3],
    unit: i32,
) -> ShortAccumulator {
    let mut sum = ShortAccumulator::of_units(unit);
    for (i, x) in x.into_iter().enumerate() {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        sum.add_integers([x, y[j], z[k]]);
        sum.add_integers([-x, y[k], z[j]]);
    }
    sum
}

/// The product, for which processors have an instruction.
#[inline]
pub(super) fn times(a: i64, b: i64) -> i128 {
    i128::from(a) * i128::from(b)
}

/// The sign of the sum of products: of integers below 2^60 with others below 2^124. Of products in two parts, for
/// they have 184 bits.
#[inline]
pub(super) fn sign_of_products(pairs: [(i64, i128); 3]) -> Ordering {
    const LOW_BITS: i32 = 62;
    const LOW: i128 = (1 << LOW_BITS) - 1;
    let (mut high, mut low) = (0, 0);
    for (a, b) in pairs {
        high += times(a, (b >> LOW_BITS) as i64);
        low += times(a, (b & LOW) as i64);
    }
    // The sum is high · 2^62 + low, of which low gets the same sign or zero: from 0 to 2^62.
    high += low >> LOW_BITS;
    high.cmp(&0).then((low & LOW).cmp(&0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_few_digits_are_integers_in_their_proportions() {
        let largest = 1_i64 << (BITS - 1);
        assert_eq!(on_lattice([1.0, -0.5, 0.0]), Some([largest, -largest / 2, 0]));
        assert_eq!(
            on_lattice([3e-30_f32, 1.5e-30].map(f64::from)).map(|[a, b]| a - 2 * b),
            Some(0)
        );
        assert_eq!(on_lattice([0.0, -0.0]), Some([0, 0]));
        let below = on_lattice([2.0_f32.next_down(), 1.0].map(f64::from));
        assert!(below.is_some_and(|[a, b]| a < 2 * largest && b == largest));
    }

    #[test]
    fn products_of_many_digits_have_their_sign() {
        let (a, b) = ((1_i64 << BITS) - 1, (1_i128 << 124) - 1);
        let equal = Ordering::Equal;
        assert_eq!(sign_of_products([(a, b), (-a, b), (0, b)]), equal);
        assert_eq!(sign_of_products([(a, b), (-a, b - 1), (0, 1)]), Ordering::Greater);
        assert_eq!(sign_of_products([(a, b), (-a, b), (-1, 1)]), Ordering::Less);
        assert_eq!(sign_of_products([(-a, b), (-a, b), (-a, b)]), Ordering::Less);
        assert_eq!(sign_of_products([(a, b), (a, b), (a, b)]), Ordering::Greater);
        // 2^62 · 1 against 2^59 · 8, of which each is in another part.
        assert_eq!(sign_of_products([(1, 1 << 62), (1 << (BITS - 1), -8), (0, 0)]), equal);
    }

    #[test]
    fn numbers_of_all_digits_are_long_integers() {
        let third = 1.0 / 3.0;
        let points = [[third, -1e-17 * third, 0.0], [-0.0, -0.5, 1e-18]];
        let (integers, unit) = on_long_lattice(points).unwrap();
        let scale = 2.0_f64.powi(unit);
        assert_eq!(integers.map(|p| p.map(|x| x as f64 * scale)), points);
        assert_eq!(on_long_lattice([[1.0, 1e-21 * third, 0.0]]), None);
        let power = 2.0_f64.powi(-117);
        assert_eq!(on_long_lattice([[1.0, power, 0.0]]), Some(([[1 << 117, 1, 0]], -117)));
        assert_eq!(on_long_lattice([[1.0, 0.5 * power, 0.0]]), None);
        for x in [0.0, f64::from_bits(3), -1e-310, f64::MIN_POSITIVE, 1e250, f64::MAX] {
            let ([p], unit) = on_long_lattice([[x, 0.0, -x]]).unwrap();
            let mut value = ShortAccumulator::of_units(unit);
            value.add_integers([p[0], 1, 1]);
            assert_eq!(value.value().divided_by(1.0.into()), x);
            assert_eq!(p, [p[0], 0, -p[0]]);
        }
    }

    #[test]
    fn what_has_more_digits_is_left_alone() {
        assert_eq!(on_lattice([1.0, 1e-9 / 3.0]), None);
        assert_eq!(on_lattice([1.0, 2.0_f64.powi(-BITS)]), None);
        assert!(on_lattice([1.0, 2.0_f64.powi(1 - BITS)]).is_some());
        for x in [2.0_f64.powi(300), 2.0_f64.powi(600)] {
            assert_eq!(on_lattice([x, 1.0 / x]), None);
            assert_eq!(on_lattice([x, f64::from_bits(1)]), None);
        }
        for x in [1e-250, 1e250, f64::INFINITY, f64::NAN] {
            assert_eq!(on_lattice([x, 1.0 / 3.0]), None, "{x}");
        }
    }
}
