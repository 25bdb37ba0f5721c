//! Numbers of few digits, as integers: the short way to exact signs.

/// As many bits as coordinates may have: their differences have one more, products of two differences 83, those
/// with a direction's component 123, and the sum of three of these fits 127.
const BITS: i32 = 40;

/// Far from overflow and underflow.
const SIZES: std::ops::Range<f64> = 1e-200..1e200;

/// The numbers times a power of two that they share and that makes all of them integers below 2^40; `None`
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
    fn what_has_more_digits_is_left_alone() {
        assert_eq!(on_lattice([1.0, 1.0 / 3.0]), None);
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
