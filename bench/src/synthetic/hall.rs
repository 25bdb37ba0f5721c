//! A teapot in a stadium: a small object of many triangles in a huge hall of few.

use super::{FixedView, Mesh};
use std::f64::consts::{PI, TAU};

/// Around and down the object.
const OBJECT: [u32; 2] = [700, 350];

/// Rows and columns of pillars, and the sides of each.
const PILLARS: [u32; 2] = [12, 8];
const SIDES: u32 = 16;

/// All of them: the object, six walls, and the pillars.
#[cfg(test)]
pub(super) const TRIANGLES: u32 =
    2 * OBJECT[0] * OBJECT[1] + 12 + PILLARS[0] * PILLARS[1] * SIDES * 2;

/// The middle of the floor, where the object is.
const CENTER: [f64; 3] = [0.0, 1.0, 0.0];

/// A few steps from the object, the light under the roof.
pub(super) const VIEW: FixedView = FixedView {
    eye: [2.2, 1.9, 3.4],
    look_at: [0.0, 1.1, 0.0],
    up: [0.0, 1.0, 0.0],
    vfov_degrees: 45.0,
    light: [15.0, 24.0, 20.0],
};

/// A hall of 120 x 30 x 80 with a knobbly ball of radius 0.6 in it.
pub(super) fn hall() -> Mesh {
    let mut mesh = Mesh::default();
    walls(&mut mesh, [60.0, 15.0, 40.0]);
    for row in 0..PILLARS[0] {
        for column in 0..PILLARS[1] {
            let place = |i: u32, count: u32| (f64::from(i) + 0.5) / f64::from(count) - 0.5;
            pillar(&mut mesh, [120.0 * place(row, PILLARS[0]), 80.0 * place(column, PILLARS[1])]);
        }
    }
    object(&mut mesh);
    mesh
}

/// The six sides of a box around (0, half height, 0).
fn walls(mesh: &mut Mesh, half: [f64; 3]) {
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            mesh.grid(1, 1, |u, v| {
                let mut point = [0.0; 3];
                point[axis] = side * half[axis];
                point[(axis + 1) % 3] = (2.0 * f64::from(u) - 1.0) * half[(axis + 1) % 3];
                point[(axis + 2) % 3] = (2.0 * f64::from(v) - 1.0) * half[(axis + 2) % 3];
                [point[0], point[1] + half[1], point[2]]
            });
        }
    }
}

/// A round pillar from the floor to the roof.
fn pillar(mesh: &mut Mesh, [x, z]: [f64; 2]) {
    mesh.grid(SIDES, 1, |side, end| {
        let angle = TAU * f64::from(side) / f64::from(SIDES);
        [x + 0.8 * angle.cos(), 30.0 * f64::from(end), z + 0.8 * angle.sin()]
    });
}

/// A ball with waves on it.
fn object(mesh: &mut Mesh) {
    mesh.grid(OBJECT[0], OBJECT[1], |around, down| {
        let phi = TAU * f64::from(around) / f64::from(OBJECT[0]);
        let theta = PI * f64::from(down) / f64::from(OBJECT[1]);
        let waves = (9.0 * phi).sin() * (11.0 * theta).sin() + 0.3 * (43.0 * theta).cos();
        let radius = 0.6 * (1.0 + 0.12 * waves * theta.sin());
        let across = radius * theta.sin();
        [
            CENTER[0] + across * phi.cos(),
            CENTER[1] + radius * theta.cos(),
            CENTER[2] + across * phi.sin(),
        ]
    });
}
