//! Spheres, and flakes of them.

use super::assembly::{Corner, Shape};
use glam::{DAffine3, DQuat, DVec3};
use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI, TAU};

/// The unit sphere as an octahedron whose triangles are cut in four `levels` times: 8·4^levels.
pub(super) fn sphere(levels: u32) -> Shape {
    let mut points = vec![DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z];
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    for (x, y, z) in (0..8).map(|i| (i & 1, i >> 1 & 1, i >> 2)) {
        let [a, b, c] = [3 * x, 1 + 3 * y, 2 + 3 * z];
        triangles.push(if (x + y + z) % 2 == 0 { [a, b, c] } else { [a, c, b] });
    }
    for _ in 0..levels {
        triangles = cut_in_four(&triangles, &mut points);
    }
    Shape { corners: points.into_iter().map(on_sphere).collect(), triangles }
}

fn cut_in_four(triangles: &[[u32; 3]], points: &mut Vec<DVec3>) -> Vec<[u32; 3]> {
    let mut middles = HashMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            points.push((points[a as usize] + points[b as usize]).normalize());
            points.len() as u32 - 1
        })
    };
    let mut cut = Vec::with_capacity(4 * triangles.len());
    for &[a, b, c] in triangles {
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        cut.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    cut
}

/// A point of the unit sphere, with the height as the second texture coordinate; the first goes
/// back and forth around it, so that it has no seam.
fn on_sphere(point: DVec3) -> Corner {
    let around = point.z.atan2(point.x).abs() / PI;
    let down = point.y.clamp(-1.0, 1.0).acos() / PI;
    Corner { position: point, normal: point, uv: [around, down] }
}

/// Where the unit sphere goes for each ball of Haines's sphereflake (IEEE CG&A, 1987): on a ball
/// sit nine of a third of its size, six around its equator and three above, and on each of those
/// the next nine.
pub(super) fn sphereflake(levels: u32) -> Vec<DAffine3> {
    let mut all = vec![DAffine3::IDENTITY];
    let mut last = all.clone();
    let seats: Vec<_> = seats().collect();
    for _ in 0..levels {
        last = last.iter().flat_map(|ball| seats.iter().map(move |seat| *ball * *seat)).collect();
        all.extend(&last);
    }
    all
}

fn seats() -> impl Iterator<Item = DAffine3> {
    let equator = (0..6).map(|i| (FRAC_PI_2, f64::from(i) * FRAC_PI_3));
    let above = (0..3).map(|i| (PI / 6.0, PI / 6.0 + f64::from(i) * TAU / 3.0));
    equator.chain(above).map(|(tilt, turn)| {
        // The seat's +y points away from the ball that it is on.
        let rotation = DQuat::from_rotation_y(turn) * DQuat::from_rotation_x(tilt);
        let third = 1.0 / 3.0;
        DAffine3::from_scale_rotation_translation(
            DVec3::splat(third),
            rotation,
            rotation * DVec3::Y * (1.0 + third),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::super::assembly::tests::assert_closed;
    use super::*;

    #[test]
    fn a_sphere_is_closed_and_round() {
        let shape = sphere(3);
        assert_eq!(shape.triangles.len(), 512);
        assert_closed(&shape);
        assert!(shape.corners.iter().all(|c| (c.position.length() - 1.0).abs() < 1e-12));
    }

    #[test]
    fn balls_of_a_flake_touch_the_ball_they_sit_on() {
        let balls = sphereflake(2);
        assert_eq!(balls.len(), 1 + 9 + 81);
        let center = |i: usize| balls[i].translation;
        for child in 0..9 {
            assert!((center(1 + child).length() - 4.0 / 3.0).abs() < 1e-12);
            let grandchild = center(10 + 9 * child);
            assert!((grandchild.distance(center(1 + child)) - 4.0 / 9.0).abs() < 1e-12);
        }
    }
}
