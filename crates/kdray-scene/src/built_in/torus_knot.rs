//! A tube along a torus knot.

use super::assembly::{Corner, Shape};
use glam::{DQuat, DVec3};
use std::f64::consts::TAU;

/// A tube of radius `tube` along the knot that winds `p` times around the axis (y) of a torus of
/// radii 1 and 0.45 and `q` times through its hole, of `rings` rings of `sides` quadrilaterals.
/// Texture coordinates count from 0 to 1 along and around it.
pub(super) fn torus_knot(p: u32, q: u32, tube: f64, rings: u32, sides: u32) -> Shape {
    let mut shape = Shape::default();
    let frames = frames(&|s| knot(p, q, s), rings);
    for (ring, (center, across)) in frames.iter().enumerate() {
        let along = f64::from(ring as u32) / f64::from(rings);
        let tangent = (knot(p, q, along + 1e-5) - knot(p, q, along - 1e-5)).normalize();
        for side in 0..sides {
            let share = f64::from(side) / f64::from(sides);
            let normal = DQuat::from_axis_angle(tangent, share * TAU) * *across;
            let position = *center + tube * normal;
            shape.corners.push(Corner { position, normal, uv: [along, share] });
        }
    }
    for ring in 0..rings {
        for side in 0..sides {
            let corner = |ring: u32, side: u32| (ring % rings) * sides + side % sides;
            shape.quad([
                corner(ring, side),
                corner(ring, side + 1),
                corner(ring + 1, side + 1),
                corner(ring + 1, side),
            ]);
        }
    }
    shape
}

fn knot(p: u32, q: u32, s: f64) -> DVec3 {
    let (around, through) = (f64::from(p) * s * TAU, f64::from(q) * s * TAU);
    let radius = 1.0 + 0.45 * through.cos();
    DVec3::new(radius * around.cos(), 0.45 * through.sin(), radius * around.sin())
}

/// Points of a closed curve, each with a unit vector across it that turns as little as possible
/// from one to the next. What it has turned after one round is taken back evenly along the curve,
/// so that the end meets the start.
fn frames(curve: &dyn Fn(f64) -> DVec3, count: u32) -> Vec<(DVec3, DVec3)> {
    let at = |i: u32| f64::from(i) / f64::from(count);
    let tangent = |s: f64| (curve(s + 1e-5) - curve(s - 1e-5)).normalize();
    let start = tangent(0.0).any_orthonormal_vector();
    let mut across = vec![start];
    for i in 0..count {
        let turn = DQuat::from_rotation_arc(tangent(at(i)), tangent(at(i + 1)));
        across.push(turn * across[i as usize]);
    }
    let (end, axis) = (across[count as usize], tangent(0.0));
    let excess = start.cross(end).dot(axis).atan2(start.dot(end));
    let frame = |i: u32| {
        let back = DQuat::from_axis_angle(tangent(at(i)), -excess * at(i));
        (curve(at(i)), back * across[i as usize])
    };
    (0..count).map(frame).collect()
}

#[cfg(test)]
mod tests {
    use super::super::assembly::tests::assert_closed;
    use super::*;

    #[test]
    fn the_tube_is_closed_and_keeps_its_radius() {
        let shape = torus_knot(2, 3, 0.2, 200, 12);
        assert_eq!(shape.triangles.len(), 2 * 200 * 12);
        assert_closed(&shape);
        for (i, corner) in shape.corners.iter().enumerate() {
            let center = knot(2, 3, f64::from(i as u32 / 12) / 200.0);
            assert!((corner.position.distance(center) - 0.2).abs() < 1e-9);
        }
    }
}
