//! Rays that leave surfaces: no acne outside, no leak inside.

use super::{HitPoint, Surface};
use crate::World;
use crate::sampling::{Sampler, cosine_hemisphere, tangents};
use glam::{DVec3, Vec3};
use kdray::{BuildOptions, Hit, Ray, Side, TriangleMesh};
use kdray_scene::Model;

/// A closed ball around `center`, rounded to f32 there.
fn ball(center: f64, radius: f64) -> World {
    const RINGS: u32 = 24;
    const SIDES: u32 = 48;
    let point = |ring: u32, side: u32| {
        let (down, around) =
            (f64::from(ring) / f64::from(RINGS), f64::from(side) / f64::from(SIDES));
        let (sin, cos) = (down * std::f64::consts::PI).sin_cos();
        let (z, x) = (around * std::f64::consts::TAU).sin_cos();
        (DVec3::splat(center) + radius * DVec3::new(sin * x, cos, sin * z)).as_vec3()
    };
    let last = (RINGS - 1) * SIDES + 1;
    let index = |ring: u32, side: u32| match ring {
        0 => 0,
        RINGS => last,
        _ => 1 + (ring - 1) * SIDES + side % SIDES,
    };
    let mut vertices = vec![point(0, 0)];
    vertices.extend(
        (1..RINGS)
            .flat_map(|ring| (0..SIDES).map(move |side| (ring, side)))
            .map(|(r, s)| point(r, s)),
    );
    vertices.push(point(RINGS, 0));
    let mut triangles = Vec::new();
    for (ring, side) in (0..RINGS).flat_map(|ring| (0..SIDES).map(move |side| (ring, side))) {
        let [a, b, c, d] = [(0, 0), (0, 1), (1, 1), (1, 0)].map(|(r, s)| index(ring + r, side + s));
        triangles.extend(
            [[a, b, c], [a, c, d]].into_iter().filter(|[a, b, c]| a != b && b != c && c != a),
        );
    }
    let vertices = vertices.into_iter().map(|p: Vec3| p.to_array()).collect();
    let model = Model { vertices, triangles, ..Model::default() };
    World::new(model, &BuildOptions::default()).unwrap()
}

/// Hits of rays from outside towards points well inside, each with the ray.
fn hits(world: &World, center: f64, radius: f64) -> Vec<(Ray, Hit)> {
    let sampler = Sampler::new(3, [0, 0], 0, 1);
    let count = 2000;
    let hit = |i: u32| {
        let [h, turn] = sampler.point(i, count);
        let (sin, cos) = (turn * std::f64::consts::TAU).sin_cos();
        let flat = (1.0 - (2.0 * h - 1.0).powi(2)).sqrt();
        let from =
            DVec3::splat(center) + 3.0 * radius * DVec3::new(flat * cos, 2.0 * h - 1.0, flat * sin);
        let [x, y] = sampler.fork(1).point(i, count);
        let to = DVec3::splat(center) + 0.3 * radius * DVec3::new(x, y, x - y);
        let ray = Ray::new(from, (to - from).normalize());
        world.scene().closest_hit(&ray).map(|hit| (ray, hit))
    };
    (0..count).map(|i| hit(i).expect("the ball is met")).collect()
}

#[test]
fn rays_leave_a_closed_ball_without_acne_and_stay_inside_without_leaks() {
    for (center, radius) in [(0.0, 1.0), (1e6, 1e3), (-1e6, 50.0), (0.0, 1e-6), (3.0, 1e5)] {
        let world = ball(center, radius);
        let directions = Sampler::new(8, [0, 0], 0, 1);
        for (ray, hit) in hits(&world, center, radius) {
            let surface = Surface::new(&world, &ray, &hit);
            let (x, y) = tangents(surface.at.facing);
            for i in 0..8 {
                let local = cosine_hemisphere(directions.point(i, 8));
                let outward = x * local.x + y * local.y + surface.at.facing * local.z;
                // Outside the ball bulges nowhere above the plane of a triangle, but for the
                // rounding of its vertices, which at 1e6 makes it a little uneven.
                let leaving = world.scene().closest_hit(&surface.at.ray_along(outward));
                let own = |h: &Hit| h.primitive_id == hit.primitive_id;
                assert!(!leaving.as_ref().is_some_and(own), "acne at {center}");
                if center.abs() < 1e6 {
                    assert_eq!(leaving, None, "acne at {center}, {radius}");
                }
                let inward = surface.at.ray_along(-outward);
                let met = world.scene().closest_hit(&inward).expect("a leak");
                assert!(met.primitive_id != hit.primitive_id);
                assert_eq!(world.scene().count(&inward) % 2, 1, "it starts inside");
            }
        }
    }
}

#[test]
fn a_sliver_without_a_computed_normal_faces_the_viewer_from_both_sides() {
    // So thin that f64 loses its height; yet it is hit, as hits are exact.
    let thin = [[1e-30, 0.0, 0.0], [2.0, 2.0, 0.0], [1.0, 1.0, 0.0]];
    let mesh = TriangleMesh::from_soup([thin]).unwrap();
    let hit = |side| Hit { t: 1.0, primitive_id: 0, u: 0.25, v: 0.25, side };
    for length in [0.05, 5e-202, 5e-324, 1e300] {
        let ray = Ray::new([0.75, 0.8, 0.0], [0.0, -length, 0.0]);
        assert_eq!(ray.check(), Ok(()));
        for side in [Side::Front, Side::Back] {
            let facing = HitPoint::new(&mesh, &ray, &hit(side)).facing();
            assert_eq!(facing, [0.0, 1.0, 0.0], "{length}, {side:?}");
        }
    }
}

#[test]
fn a_ray_to_a_point_is_there_at_one() {
    let world = ball(1e6, 1e3);
    for (ray, hit) in hits(&world, 1e6, 1e3).into_iter().take(100) {
        let target = DVec3::new(1.2e6, 0.9e6, 1e6);
        let to = Surface::new(&world, &ray, &hit).at.ray_to(target);
        assert!(DVec3::from(to.at(1.0)).distance(target) < 1e-9);
    }
}
