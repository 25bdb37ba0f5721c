//! Answers that are the same to the last bit, signs of zeros included: `==` takes -0 for 0.

use kdray::{Hit, Side};

/// Something that is the same only if all bits are.
pub trait Bits {
    /// Whether it is.
    fn is_same(&self, other: &Self) -> bool;
}

/// A hit as numbers that are equal only if all bits are.
pub fn bits(hit: &Hit) -> (u64, u32, [u64; 2], Side) {
    (hit.t.to_bits(), hit.primitive_id, [hit.u.to_bits(), hit.v.to_bits()], hit.side)
}

impl Bits for Hit {
    fn is_same(&self, other: &Self) -> bool {
        bits(self) == bits(other)
    }
}

impl Bits for bool {
    fn is_same(&self, other: &Self) -> bool {
        self == other
    }
}

impl Bits for usize {
    fn is_same(&self, other: &Self) -> bool {
        self == other
    }
}

impl<T: Bits> Bits for [T] {
    fn is_same(&self, other: &Self) -> bool {
        self.len() == other.len() && self.iter().zip(other).all(|(a, b)| a.is_same(b))
    }
}

impl<T: Bits> Bits for Vec<T> {
    fn is_same(&self, other: &Self) -> bool {
        self[..].is_same(&other[..])
    }
}

impl<T: Bits> Bits for Option<T> {
    fn is_same(&self, other: &Self) -> bool {
        self.as_slice().is_same(other.as_slice())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_have_signs() {
        let hit = |u: f64| Hit { t: 1.0, primitive_id: 3, u, v: 0.5, side: Side::Front };
        assert!(hit(-0.0) == hit(0.0) && !hit(-0.0).is_same(&hit(0.0)));
        assert!(Some(hit(0.0)).is_same(&Some(hit(0.0))) && !Some(hit(0.0)).is_same(&None));
        assert!(!vec![hit(0.0)].is_same(&vec![hit(0.0), hit(1.0)]));
    }
}
