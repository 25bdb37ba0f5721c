//! What a piece of surface looks like from afar.

use glam::{DMat3, DVec3};

/// The terms of ∫ n · K(x) dA over a piece of surface, with K(x) = x / |x|³, up to the second
/// derivative of K at a middle that is given (Barill et al. 2018, eq. 13 and their supplement).
///
/// K is a gradient and has no divergence, so its derivatives are symmetric without a trace; of the
/// moments only the symmetric parts count, and traces count for nothing.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Moments {
    /// ∫ n.
    normal: DVec3,
    /// ∫ n yᵀ with y from the middle, symmetric: xx, yy, zz, yz, zx, xy.
    first: [f64; 6],
    /// ∫ n ⊗ y ⊗ y, symmetric: xxx, yyy, zzz, xyz, then xxy, yyz, zzx, then xxz, yyx, zzy.
    second: [f64; 10],
}

/// The components of `second`.
const TRIPLES: [[usize; 3]; 10] = [
    [0, 0, 0],
    [1, 1, 1],
    [2, 2, 2],
    [0, 1, 2],
    [0, 0, 1],
    [1, 1, 2],
    [2, 2, 0],
    [0, 0, 2],
    [1, 1, 0],
    [2, 2, 1],
];

/// The components of `first`.
const PAIRS: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [1, 2], [2, 0], [0, 1]];

impl Moments {
    /// Adds a triangle of that normal, of its area in length, with corners relative to the middle.
    pub(super) fn add(&mut self, n: DVec3, corners: [DVec3; 3]) {
        let sum = corners[0] + corners[1] + corners[2];
        // ∫ y = A sum / 3 and ∫ y yᵀ = A (Σ c cᵀ + sum sumᵀ) / 12 over a triangle.
        let squares = corners.iter().chain([&sum]).fold(DMat3::ZERO, |squares, c| {
            squares + DMat3::from_cols(*c * c.x, *c * c.y, *c * c.z)
        });
        self.normal += n;
        for (place, [k, l]) in self.first.iter_mut().zip(PAIRS) {
            *place += (n[k] * sum[l] + n[l] * sum[k]) / 6.0;
        }
        for (place, [j, k, l]) in self.second.iter_mut().zip(TRIPLES) {
            let [jk, kl, lj] = [(j, k), (k, l), (l, j)].map(|(a, b)| squares.col(a)[b]);
            *place += (n[j] * kl + n[k] * lj + n[l] * jk) / 36.0;
        }
    }

    /// The integral seen from a point, from which the middle lies at `distance` in the direction
    /// `unit`.
    pub(crate) fn seen(&self, unit: DVec3, distance: f64) -> f64 {
        let inverse = 1.0 / distance;
        let zeroth = self.normal.dot(unit);
        let first = self.first_seen(unit) * inverse;
        let second = self.second_seen(unit) * inverse * inverse;
        (zeroth + first + second) * inverse * inverse
    }

    /// M : K', with K' = I − 3 d dᵀ for a unit vector d.
    fn first_seen(&self, d: DVec3) -> f64 {
        let [xx, yy, zz, yz, zx, xy] = self.first;
        let form = xx * d.x * d.x
            + yy * d.y * d.y
            + zz * d.z * d.z
            + 2.0 * (yz * d.y * d.z + zx * d.z * d.x + xy * d.x * d.y);
        xx + yy + zz - 3.0 * form
    }

    /// S ⁝ K'' / 2, with K'' = 15 d d d − 3 (I d + …, symmetric) for a unit vector d.
    fn second_seen(&self, d: DVec3) -> f64 {
        let [xxx, yyy, zzz, xyz, xxy, yyz, zzx, xxz, yyx, zzy] = self.second;
        let squares = d * d;
        let form = d.x * (xxx * squares.x + 3.0 * (yyx * squares.y + zzx * squares.z))
            + d.y * (yyy * squares.y + 3.0 * (zzy * squares.z + xxy * squares.x))
            + d.z * (zzz * squares.z + 3.0 * (xxz * squares.x + yyz * squares.y))
            + 6.0 * xyz * d.x * d.y * d.z;
        let trace = DVec3::new(xxx + yyx + zzx, yyy + zzy + xxy, zzz + xxz + yyz);
        0.5 * (15.0 * form - 9.0 * trace.dot(d))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitives::solid_angle;
    use std::f64::consts::PI;

    /// The error falls with the fourth power of the distance over the size, after three terms.
    #[test]
    fn from_afar_it_is_the_solid_angle() {
        let corners = [[0.3, -0.1, 0.2], [-0.4, 0.5, 0.0], [0.1, -0.2, -0.6]].map(DVec3::from);
        let mut moments = Moments::default();
        moments.add(0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]), corners);
        for direction in [[1.0, 0.0, 0.0], [0.3, -0.7, 0.2], [-0.1, -0.1, 1.0]] {
            let unit = DVec3::from(direction).normalize();
            let error = |distance: f64| {
                let exact = solid_angle((-unit * distance).into(), corners.map(Into::into));
                let seen = moments.seen(unit, distance) / (4.0 * PI);
                (seen / exact - 1.0).abs()
            };
            assert!(error(20.0) < 1e-3 && error(200.0) < 2e-6, "{unit}: {}", error(200.0));
        }
    }
}
