//! Hair: thousands of thin curved strands on a ball, the worst case for boxes along the axes.

use super::{FixedView, Mesh};
use glam::DVec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::f64::consts::TAU;

/// How many strands, of how many pieces of a three-sided tube.
const STRANDS: u32 = 12_000;
const PIECES: u32 = 10;
const SIDES: u32 = 3;

/// Around and down the ball.
const BALL: [u32; 2] = [60, 30];

/// All of them.
#[cfg(test)]
pub(super) const TRIANGLES: u32 = STRANDS * PIECES * SIDES * 2 + 2 * BALL[0] * BALL[1];

/// In front of the ball.
pub(super) const VIEW: FixedView = FixedView {
    eye: [0.4, 0.9, 4.6],
    look_at: [0.0, -0.1, 0.0],
    up: [0.0, 1.0, 0.0],
    vfov_degrees: 40.0,
    light: [3.0, 4.0, 3.5],
};

/// A ball of radius 1 with strands about as long as that.
pub(super) fn hair() -> Mesh {
    let mut mesh = Mesh::default();
    mesh.grid(BALL[0], BALL[1], |around, down| {
        let phi = TAU * f64::from(around) / f64::from(BALL[0]);
        let theta = TAU / 2.0 * f64::from(down) / f64::from(BALL[1]);
        [theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin()]
    });
    let mut random = Pcg64Mcg::seed_from_u64(7);
    for _ in 0..STRANDS {
        strand(&mut mesh, &mut random);
    }
    mesh
}

/// A tube that leaves the ball, bends down and waves a little.
fn strand(mesh: &mut Mesh, random: &mut Pcg64Mcg) {
    let height: f64 = random.random_range(-0.4..1.0);
    let angle: f64 = random.random_range(0.0..TAU);
    let across = (1.0 - height * height).sqrt();
    let root = DVec3::new(across * angle.cos(), height, across * angle.sin());
    let length = random.random_range(0.7..1.3);
    let wave = random.random_range(4.0..9.0);
    let phase = random.random_range(0.0..TAU);
    let side = root.any_orthonormal_vector();
    let middle = |s: f64| {
        root * (1.0 + length * 0.45 * s)
            + DVec3::NEG_Y * (length * 0.7 * s * s)
            + side * (0.06 * s * (wave * s + phase).sin())
    };
    let other = root.cross(side);
    mesh.grid(SIDES, PIECES, |corner, piece| {
        let s = f64::from(piece) / f64::from(PIECES);
        let turn = TAU * f64::from(corner) / f64::from(SIDES);
        let radius = 0.003 * (1.0 - 0.8 * s);
        (middle(s) + radius * (side * turn.cos() + other * turn.sin())).into()
    });
}
