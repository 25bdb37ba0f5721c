//! The oracle itself, on answers that are known without it.

use kdray::primitives::HitRule::{Crossing, Touching};
use kdray::{Interval, Ray, Side};
use kdray_tests::oracle::{
    agrees_on_all, agrees_on_closest, exact_segment_hit, exact_triangle_hit,
};

const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 2.0], [4.0, 0.0, 2.0], [0.0, 4.0, 2.0]];

fn down(x: f64, y: f64) -> Ray<3> {
    Ray::new([x, y, 6.0], [0.0, 0.0, -2.0])
}

#[test]
fn a_hit_inside_has_the_weights_of_its_point() {
    let hit = exact_triangle_hit(&TRIANGLE, 7, &down(1.0, 2.0), Touching).unwrap();
    assert_eq!((hit.primitive_id, hit.u, hit.v, hit.side), (7, 0.25, 0.5, Side::Front));
    assert_eq!(hit.t, num_rational::BigRational::from_integer(2.into()));
    let up = Ray::new([1.0, 2.0, 0.0], [0.0, 0.0, 1.0]);
    assert_eq!(exact_triangle_hit(&TRIANGLE, 7, &up, Crossing).unwrap().side, Side::Back);
}

#[test]
fn edges_belong_to_a_triangle_and_their_surroundings_do_not() {
    let tiny = f64::from_bits(1);
    for (x, y) in [(0.0, 0.0), (4.0, 0.0), (2.0, 2.0), (1.0, 0.0), (0.0, 3.0)] {
        assert!(exact_triangle_hit(&TRIANGLE, 0, &down(x, y), Touching).is_some());
    }
    for (x, y) in [(-tiny, 1.0), (1.0, -tiny), (2.0, 2.0 + f64::EPSILON * 2.0)] {
        assert!(exact_triangle_hit(&TRIANGLE, 0, &down(x, y), Touching).is_none(), "{x} {y}");
    }
}

#[test]
fn of_triangles_around_a_vertex_one_is_crossed() {
    let center = [0.0, 0.0, 2.0];
    let ring = [[3.0, 0.0, 2.0], [0.0, 3.0, 2.0], [-3.0, 0.0, 2.0], [0.0, -3.0, 2.0]];
    for origin in [[0.0, 0.0, 6.0], [1.0, 2.0, 6.0], [-1.0, -7.0, 6.0], [0.0, 5.0, -1.0]] {
        let ray = Ray::through(origin, [0.0, 0.0, 2.0]);
        let fan = (0..4).map(|i| [center, ring[i], ring[(i + 1) % 4]]);
        let hits =
            |rule| fan.clone().filter(|t| exact_triangle_hit(t, 0, &ray, rule).is_some()).count();
        assert_eq!((hits(Touching), hits(Crossing)), (4, 1), "{origin:?}");
    }
}

#[test]
fn rays_in_the_plane_and_flat_triangles_miss() {
    let inside = Ray::new([-1.0, 1.0, 2.0], [1.0, 0.0, 0.0]);
    let line = [[0.0, 0.0, 2.0], [4.0, 0.0, 2.0], [2.0, 0.0, 2.0]];
    for rule in [Touching, Crossing] {
        assert!(exact_triangle_hit(&TRIANGLE, 0, &inside, rule).is_none());
        assert!(exact_triangle_hit(&line, 0, &down(1.0, 0.0), rule).is_none());
    }
}

#[test]
fn of_two_segments_that_meet_on_the_ray_one_is_crossed() {
    let (left, tip, right) = ([-2.0, 1.0], [0.0, 2.0], [3.0, 1.0]);
    // From within the wedge, from beside it past the tip, and from its other side.
    for (origin, crossed) in [([0.0, 0.0], true), ([5.0, 0.5], false), ([4.0, 0.0], true)] {
        let ray = Ray::through(origin, [0.0, 2.0]);
        let hits = |rule| {
            let found = |ends| exact_segment_hit(&ends, 0, &ray, rule).is_some();
            usize::from(found([left, tip])) + usize::from(found([tip, right]))
        };
        assert_eq!((hits(Touching), hits(Crossing) % 2 == 1), (2, crossed), "{origin:?}");
    }
    let hit = exact_segment_hit(&[right, left], 0, &Ray::new([0.5, 0.0], [0.0, 1.0]), Touching);
    assert_eq!(hit.map(|hit| (hit.u, hit.side)), Some((0.5, Side::Front)));
}

#[test]
fn wrong_answers_are_noticed() {
    let ray = down(1.0, 2.0);
    let exact = vec![exact_triangle_hit(&TRIANGLE, 0, &ray, Touching).unwrap()];
    let right = kdray::Hit { t: 2.0, primitive_id: 0, u: 0.25, v: 0.5, side: Side::Front };
    let all = |hits: &[kdray::Hit]| agrees_on_all(&exact, hits, &ray).is_ok();
    assert!(all(&[right]) && agrees_on_closest(&exact, Some(&right), &ray).is_ok());
    assert!(!all(&[]) && agrees_on_closest(&exact, None, &ray).is_err());
    assert!(!all(&[right, right]));
    for wrong in [
        kdray::Hit { t: 2.0 + 1e-11, ..right },
        kdray::Hit { u: 0.250_001, ..right },
        kdray::Hit { primitive_id: 1, ..right },
        kdray::Hit { side: Side::Back, ..right },
    ] {
        assert!(!all(&[wrong]) && agrees_on_closest(&exact, Some(&wrong), &ray).is_err());
    }
    let before = Ray { interval: Interval { t_min: 0.0, t_max: 1.0 }, ..ray };
    assert!(agrees_on_all(&exact, &[right], &before).is_err());
    assert!(agrees_on_all(&exact, &[], &before).is_ok());
}
