//! Sums of products without rounding (Kulisch 1971: the long accumulator).

use std::cmp::Ordering;
use std::ops::Range;

/// Limbs of 64 bits. The products of three f64 span 2^-3222 to 2^3072; what is left above holds
/// the carries of more terms than anyone adds.
const ALL_LIMBS: usize = 100;

/// Three times the power of two of the smallest f64.
const LOWEST: i32 = -3222;

/// A fixed-point number, wide enough for every sum of products of up to three finite f64 numbers; with fewer limbs,
/// for those of integers.
///
/// What is added and what is subtracted are summed apart, so that no borrow runs through all limbs whenever
/// the sum changes its sign. Only the limbs that a term has reached are looked at.
#[derive(Clone)]
pub struct Accumulator<const LIMBS: usize = ALL_LIMBS> {
    added: [u64; LIMBS],
    subtracted: [u64; LIMBS],
    /// All other limbs are zero.
    used: Range<usize>,
    /// The power of two that the lowest bit stands for.
    lowest: i32,
}

/// Wide enough for 2^24 products of three integers below 2^120: 360 bits, and 24 for carries.
pub(super) type ShortAccumulator = Accumulator<6>;

/// A number `mantissa · 2^exponent` whose exponent may be beyond that of an f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scaled {
    /// The digits; those of an accumulator's value are zero, or from 2^127 to 2^128 in size.
    pub mantissa: f64,
    /// The power of two.
    pub exponent: i32,
}

impl Default for Accumulator {
    #[inline]
    fn default() -> Self {
        Self::of_units(LOWEST)
    }
}

impl Accumulator {
    /// Adds the product of three finite numbers.
    pub fn add(&mut self, factors: [f64; 3]) {
        let [a, b, c] = factors.map(Decoded::of);
        let low = u128::from(a.mantissa) * u128::from(b.mantissa);
        if low == 0 || c.mantissa == 0 {
            return;
        }
        let product = product(limbs(low), [c.mantissa]);
        let shift = a.exponent + b.exponent + c.exponent - LOWEST;
        let negative = a.negative ^ b.negative ^ c.negative;
        self.add_shifted(product, shift as usize, negative);
    }

    /// Subtracts the product of three finite numbers.
    pub fn subtract(&mut self, [a, b, c]: [f64; 3]) {
        self.add([-a, b, c]);
    }

    /// Adds or subtracts `number · 2^shift` units of the lowest bit.
    fn add_shifted(&mut self, number: [u64; 3], shift: usize, negative: bool) {
        let (limb, bits) = (shift / 64, shift % 64);
        let [n0, n1, n2] = number;
        let spill = |n: u64| if bits == 0 { 0 } else { n >> (64 - bits) };
        let shifted = [n0 << bits, n1 << bits | spill(n0), n2 << bits | spill(n1), spill(n2)];
        let sum = if negative { &mut self.subtracted } else { &mut self.added };
        let top = add_at(sum, limb, &shifted);
        widen(&mut self.used, limb..top);
    }
}

impl ShortAccumulator {
    /// Adds the product of three integers below 2^120 in size.
    #[inline]
    pub(super) fn add_integers(&mut self, [a, b, c]: [i128; 3]) {
        let negative = (a < 0) ^ (b < 0) ^ (c < 0);
        debug_assert!([a, b, c].iter().all(|x| x.unsigned_abs() < 1 << 120));
        let [a, b, c] = [a, b, c].map(|x| limbs(x.unsigned_abs()));
        let product: [u64; 6] = product(product::<2, 2, 4>(a, b), c);
        add_at(if negative { &mut self.subtracted } else { &mut self.added }, 0, &product);
        self.used = 0..6;
    }
}

impl<const LIMBS: usize> Accumulator<LIMBS> {
    /// Zero, in units of that power of two.
    #[inline]
    pub(super) fn of_units(lowest: i32) -> Self {
        Self { added: [0; LIMBS], subtracted: [0; LIMBS], used: 0..0, lowest }
    }

    /// Adds another sum, of the same units.
    pub fn add_all(&mut self, other: &Self) {
        self.add_limbs(&other.added, &other.subtracted, &other.used);
    }

    /// Subtracts another sum, of the same units.
    pub fn subtract_all(&mut self, other: &Self) {
        self.add_limbs(&other.subtracted, &other.added, &other.used);
    }

    fn add_limbs(&mut self, added: &[u64; LIMBS], subtracted: &[u64; LIMBS], used: &Range<usize>) {
        for (sum, parts) in [(&mut self.added, added), (&mut self.subtracted, subtracted)] {
            let top = add_at(sum, used.start, parts.get(used.clone()).unwrap_or_default());
            widen(&mut self.used, used.start..top);
        }
    }

    /// The sum's sign: how it compares with zero.
    pub fn sign(&self) -> Ordering {
        let places = self.used.clone().rev();
        let orders = places.map(|i| self.added[i].cmp(&self.subtracted[i]));
        orders.fold(Ordering::Equal, Ordering::then)
    }

    /// The sum, rounded to nearest.
    pub fn value(&self) -> Scaled {
        let negative = self.sign() == Ordering::Less;
        let magnitude = self.magnitude(negative);
        let Some(top) = self.used.clone().rev().find(|&place| magnitude[place] != 0) else {
            return Scaled { mantissa: 0.0, exponent: 0 };
        };
        let limb = |below: usize| top.checked_sub(below).map_or(0, |place| magnitude[place]);
        let zeros = limb(0).leading_zeros();
        let upper = (u128::from(limb(0)) << 64 | u128::from(limb(1))) << zeros;
        let head = upper | (u128::from(limb(2)) << zeros >> 64);
        // All that lies below only matters to rounding as "a little more": the sticky bit.
        let below = self.used.start..top.saturating_sub(1).max(self.used.start);
        let sticky = magnitude[below].iter().any(|&limb| limb != 0);
        let mantissa = (head | u128::from(sticky)) as f64;
        let exponent = 64 * (top as i32 - 1) - zeros as i32 + self.lowest;
        Scaled { mantissa: if negative { -mantissa } else { mantissa }, exponent }
    }

    /// The sum without its sign, which is given.
    fn magnitude(&self, negative: bool) -> [u64; LIMBS] {
        let (more, less) = match negative {
            true => (&self.subtracted, &self.added),
            false => (&self.added, &self.subtracted),
        };
        let (mut magnitude, mut borrow) = ([0; LIMBS], false);
        for place in self.used.clone() {
            let (once, first) = more[place].overflowing_sub(less[place]);
            let (twice, second) = once.overflowing_sub(u64::from(borrow));
            (magnitude[place], borrow) = (twice, first | second);
        }
        magnitude
    }
}

/// Makes a range hold another one, too.
#[inline]
fn widen(range: &mut Range<usize>, other: Range<usize>) {
    let has_none = |range: &Range<usize>| range.start == range.end;
    if has_none(range) {
        *range = other;
    } else if !has_none(&other) {
        *range = range.start.min(other.start)..range.end.max(other.end);
    }
}

/// Adds limbs at a place; where the carry ended.
#[inline]
fn add_at(sum: &mut [u64], start: usize, parts: &[u64]) -> usize {
    let (mut end, mut carry) = (start, false);
    for (place, part) in sum[start..].iter_mut().zip(parts) {
        let (once, first) = place.overflowing_add(*part);
        let (twice, second) = once.overflowing_add(u64::from(carry));
        (*place, carry) = (twice, first | second);
        end += 1;
    }
    while carry {
        (sum[end], carry) = sum[end].overflowing_add(1);
        end += 1;
    }
    end
}

impl From<f64> for Scaled {
    fn from(mantissa: f64) -> Self {
        Self { mantissa, exponent: 0 }
    }
}

impl Scaled {
    /// The quotient as an f64: infinite if it is too large for one, and if it is too small, the
    /// smallest of its sign. So it is zero only where this is.
    pub fn divided_by(self, divisor: Self) -> f64 {
        if self.mantissa == 0.0 {
            return 0.0;
        }
        let exponent = self.exponent - divisor.exponent;
        let half = exponent / 2;
        let quotient =
            self.mantissa / divisor.mantissa * power_of_two(half) * power_of_two(exponent - half);
        not_vanished(quotient)
    }
}

/// A quotient of numbers other than zero; where it is too small for an f64, the smallest number of
/// its sign. A hit behind a ray's origin must not move into it.
#[inline]
pub(crate) fn not_vanished(quotient: f64) -> f64 {
    if quotient == 0.0 { f64::from_bits(1).copysign(quotient) } else { quotient }
}

/// 2^exponent, clamped to what an f64 holds. By its bits, since `powi` promises no precision.
fn power_of_two(exponent: i32) -> f64 {
    let exponent = exponent.clamp(-1074, 1024);
    f64::from_bits(match exponent {
        ..-1022 => 1 << (exponent + 1074),
        // Infinity from 1024 on.
        _ => ((exponent + 1023) as u64) << 52,
    })
}

/// A finite f64 as ±mantissa · 2^exponent. Others are some number, too: who asks has looked, or asks about the
/// corners of a tree file that nobody verified.
pub(super) struct Decoded {
    pub(super) mantissa: u64,
    pub(super) exponent: i32,
    pub(super) negative: bool,
}

impl Decoded {
    #[inline]
    pub(super) fn of(x: f64) -> Self {
        let bits = x.to_bits();
        let biased = (bits >> 52 & 0x7ff) as i32;
        let fraction = bits & ((1 << 52) - 1);
        let (mantissa, exponent) =
            if biased == 0 { (fraction, -1074) } else { (fraction | 1 << 52, biased - 1075) };
        Self { mantissa, exponent, negative: bits >> 63 == 1 }
    }
}

fn limbs(x: u128) -> [u64; 2] {
    [x as u64, (x >> 64) as u64]
}

/// The product of M limbs and N.
#[inline]
fn product<const M: usize, const N: usize, const SUM: usize>(
    a: [u64; M],
    b: [u64; N],
) -> [u64; SUM] {
    const { assert!(SUM == M + N) };
    let mut product = [0; SUM];
    for (j, b) in b.into_iter().enumerate() {
        let mut carry = 0;
        for (i, a) in a.into_iter().enumerate() {
            let sum = u128::from(a) * u128::from(b) + u128::from(product[i + j]) + carry;
            (product[i + j], carry) = (sum as u64, sum >> 64);
        }
        product[M + j] = carry as u64;
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn sum(terms: &[[f64; 3]]) -> Accumulator {
        let mut sum = Accumulator::default();
        for &term in terms {
            sum.add(term);
        }
        sum
    }

    fn as_f64(sum: &Accumulator) -> f64 {
        sum.value().divided_by(self::sum(&[[1.0, 1.0, 1.0]]).value())
    }

    #[test]
    fn powers_of_two_are_exact() {
        let double = |n: i32| (0..n).fold(1.0, |x: f64, _| 2.0 * x);
        let halve = |n: i32| (0..n).fold(1.0, |x: f64, _| 0.5 * x);
        for n in [0, 1, 60, 1021, 1022, 1023] {
            assert_eq!((power_of_two(n), power_of_two(-n)), (double(n), halve(n)), "{n}");
        }
        assert_eq!((power_of_two(-1074), power_of_two(-9999)), (halve(1074), halve(1074)));
        assert_eq!((power_of_two(1024), power_of_two(9999)), (f64::INFINITY, f64::INFINITY));
    }

    #[test]
    fn extremes_cancel_to_what_is_left() {
        let (huge, tiny) = (f64::MAX, f64::from_bits(1));
        let mut s = sum(&[[huge, huge, huge], [tiny, -tiny, tiny]]);
        assert_eq!(s.sign(), Ordering::Greater);
        s.subtract([huge, huge, huge]);
        assert_eq!(s.sign(), Ordering::Less);
        s.add([tiny, tiny, tiny]);
        assert_eq!(s.sign(), Ordering::Equal);
        assert_eq!(s.value(), Scaled { mantissa: 0.0, exponent: 0 });
    }

    #[test]
    fn values_are_rounded_to_nearest_with_the_sticky_bit() {
        let ulp = f64::EPSILON;
        let tie = sum(&[[1.0, 1.0, 1.0], [ulp, 0.5, 1.0]]);
        assert_eq!(as_f64(&tie), 1.0);
        let above_tie = sum(&[[1.0, 1.0, 1.0], [ulp, 0.5, 1.0], [1e-300, 1e-300, 1e-300]]);
        assert_eq!(as_f64(&above_tie), 1.0 + ulp);
        let below_tie = sum(&[[-1.0, 1.0, 1.0], [-ulp, 0.5, 1.0], [1e-200, 1e-99, 1.0]]);
        assert_eq!(as_f64(&below_tie), -1.0);
    }

    #[test]
    fn quotients_beyond_the_range_keep_their_sign() {
        let (huge, tiny) = (sum(&[[1e300, 1e300, 1.0]]), sum(&[[-1e-300, 1e-300, 1.0]]));
        let (huge, tiny) = (huge.value(), tiny.value());
        assert_eq!(tiny.divided_by(huge), -f64::from_bits(1));
        assert_eq!(huge.divided_by(tiny), f64::NEG_INFINITY);
        assert_eq!(Scaled::from(0.0).divided_by(tiny), 0.0);
    }

    proptest! {
        #[test]
        fn products_of_integers_sum_like_integers(
            terms in prop::collection::vec(prop::array::uniform3(-(1i64 << 40)..1 << 40), 0..20)
        ) {
            let mut expected: i128 = 0;
            let mut s = Accumulator::default();
            for [a, b, c] in terms {
                expected += i128::from(a) * i128::from(b) * i128::from(c);
                s.add([a as f64, b as f64, c as f64]);
            }
            prop_assert_eq!(s.sign(), expected.cmp(&0));
            prop_assert_eq!(as_f64(&s), expected as f64);
        }

        #[test]
        fn integers_sum_as_their_products_of_numbers_do(
            terms in prop::collection::vec(prop::array::uniform3(-(1i64 << 53)..1 << 53), 0..12),
            shifts in prop::array::uniform3(0..67_u32),
        ) {
            let mut short = ShortAccumulator::of_units(0);
            let mut long = Accumulator::default();
            for term in terms {
                let term: [i128; 3] = std::array::from_fn(|k| i128::from(term[k]) << shifts[k]);
                short.add_integers(term);
                long.add(term.map(|x| x as f64));
            }
            prop_assert_eq!(short.sign(), long.sign());
            prop_assert_eq!(short.value(), long.value());
        }

        #[test]
        fn single_products_round_as_the_processor_does(a in any::<f32>(), b in any::<f32>()) {
            prop_assume!(a.is_finite() && b.is_finite());
            let (a, b) = (f64::from(a), f64::from(b));
            prop_assert_eq!(as_f64(&sum(&[[a, b, 1.0]])), a * b);
        }
    }
}
