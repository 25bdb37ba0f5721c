//! How large a triangle looks from a point beside which f64 cannot tell.

use super::integers::{Vector, integers};
use kdray::Coordinate;
use num_bigint::BigInt;
use num_traits::ToPrimitive;

/// Bits of lengths beyond those that a point one unit beside an edge needs.
const SPARE_BITS: u64 = 64;

/// Quotients of numbers of so many bits are f64's, as are the numbers.
const BITS_OF_F64: u64 = 1000;

/// Half the solid angle of a triangle seen from a point that is not on it (van Oosterom and Strackee 1983), to the
/// last digits of f64: between −π and π, positive from behind.
pub fn exact_half_angle<T: Coordinate>(corners: &[[T; 3]; 3], point: [f64; 3]) -> f64 {
    let [a, b, c] = corners.map(|p| p.map(T::to_f64));
    let [a, b, c, p] = integers([a, b, c, point]);
    let [a, b, c] = [a.minus(&p), b.minus(&p), c.minus(&p)];
    // The cosines of the angles at a point one unit beside an edge differ from −1 by the square of one unit.
    let bits = 2 * [&a, &b, &c].into_iter().map(bits).max().unwrap_or(0) + SPARE_BITS;
    let [length_a, length_b, length_c] = [&a, &b, &c].map(|v| (v.dot(v) << (2 * bits)).sqrt());
    let volume = a.dot(&b.cross(&c)) << (3 * bits);
    let sides = a.dot(&b) * &length_c + b.dot(&c) * &length_a + c.dot(&a) * &length_b;
    let facing = length_a * length_b * length_c + (sides << (2 * bits));
    let excess = volume.bits().max(facing.bits()).saturating_sub(BITS_OF_F64);
    // What is shifted away keeps its sign: a negative number becomes −1 at most.
    let [volume, facing] = [volume, facing].map(|x| (x >> excess).to_f64().unwrap_or(0.0));
    volume.atan2(facing)
}

fn bits(v: &Vector<3>) -> u64 {
    v.0.iter().map(BigInt::bits).max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const TRIANGLE: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

    #[test]
    fn a_side_of_a_tetrahedron_at_a_right_angle_is_an_eighth_of_the_sphere_from_its_corner() {
        let face = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert!((exact_half_angle(&face, [0.0; 3]) - PI / 4.0).abs() < 1e-15);
    }

    #[test]
    fn beside_a_face_it_is_half_the_sphere_and_beside_an_edge_a_quarter() {
        let tiny = f64::from_bits(1);
        for (x, y, z, expected) in [
            (0.25, 0.25, tiny, -PI),
            (0.25, 0.25, -tiny, PI),
            (0.25, 0.0, tiny, -PI / 2.0),
            (0.25, -tiny, tiny, -PI / 4.0),
            (0.25, tiny, tiny, -3.0 * PI / 4.0),
            (0.25, -tiny, 0.0, 0.0),
        ] {
            let angle = exact_half_angle(&TRIANGLE, [x, y, z]);
            assert!((angle - expected).abs() < 1e-12, "{angle} from {x:e} {y:e} {z:e}");
        }
    }
}
