//! Floats as integers over one common power of two, and vectors of them.

use num_bigint::{BigInt, Sign};
use num_rational::BigRational;
use num_traits::Float;

/// A vector of K integers.
#[derive(Clone, Debug)]
pub(super) struct Vector<const K: usize>(pub(super) [BigInt; K]);

/// Vectors of finite floats, all times the same power of two, so that they are integers. A common
/// factor of all coordinates changes no sign and no ratio that the oracle looks at.
pub(super) fn integers<const K: usize, const N: usize>(floats: [[f64; K]; N]) -> [Vector<K>; N] {
    let lowest = floats.iter().flatten().filter(|&&x| x != 0.0).map(|&x| x.integer_decode().1);
    let lowest = lowest.min().unwrap_or(0);
    let integer = |x: f64| {
        let (mantissa, exponent, sign) = x.integer_decode();
        let shift = if mantissa == 0 { 0 } else { exponent - lowest };
        (BigInt::from(mantissa) * sign) << shift as usize
    };
    floats.map(|v| Vector(v.map(integer)))
}

/// The rational number of a finite float.
pub(super) fn rational(x: f64) -> BigRational {
    let (mantissa, exponent, sign) = x.integer_decode();
    let numerator = BigInt::from(mantissa) * sign;
    let power = BigInt::from(1) << usize::from(exponent.unsigned_abs());
    if exponent < 0 {
        BigRational::new(numerator, power)
    } else {
        BigRational::from(numerator * power)
    }
}

/// A quotient, in lowest terms. `divisor` is not zero.
pub(super) fn ratio(dividend: BigInt, divisor: BigInt) -> BigRational {
    BigRational::new(dividend, divisor)
}

pub(super) fn sign(x: &BigInt) -> Sign {
    x.sign()
}

impl<const K: usize> Vector<K> {
    pub(super) fn minus(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|k| &self.0[k] - &other.0[k]))
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|k| &self.0[k] + &other.0[k]))
    }

    pub(super) fn times(&self, factor: &BigInt) -> Self {
        Self(std::array::from_fn(|k| &self.0[k] * factor))
    }

    pub(super) fn dot(&self, other: &Self) -> BigInt {
        (0..K).map(|k| &self.0[k] * &other.0[k]).sum()
    }
}

impl<const K: usize> Vector<K> {
    /// One along an axis.
    pub(super) fn step(axis: usize) -> Self {
        Self(std::array::from_fn(|k| BigInt::from(u8::from(k == axis))))
    }
}

impl Vector<3> {
    pub(super) fn cross(&self, other: &Self) -> Self {
        let (a, b) = (&self.0, &other.0);
        Self([
            &a[1] * &b[2] - &a[2] * &b[1],
            &a[2] * &b[0] - &a[0] * &b[2],
            &a[0] * &b[1] - &a[1] * &b[0],
        ])
    }
}

impl Vector<2> {
    /// The vector turned left by a right angle.
    pub(super) fn left(&self) -> Self {
        Self([-&self.0[1], self.0[0].clone()])
    }
}
