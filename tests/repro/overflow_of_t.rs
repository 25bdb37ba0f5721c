//! T of f64 triangles between 1e103 and 1e150 overflowed, and with it what t may be off by: the hit was lost wherever
//! the ray's interval had an end, and so was a nearer one behind a farther.

use kdray::primitives::{HitRule, intersect_triangle};
use kdray::{BuildOptions, Ray, Scene, TriangleMesh};

#[test]
fn a_large_triangle_is_hit_within_an_interval() {
    for exponent in [340, 346, 400, 465, 495] {
        let size = 2.0_f64.powi(exponent);
        let [a, b, c] =
            [[-size, -size, size], [2.0 * size, -size, size], [-size, 2.0 * size, size]];
        let ahead = Ray::new([0.0; 3], [0.0, 0.0, 1.0]);
        let behind = Ray::new([0.0; 3], [0.0, 0.0, -1.0]);
        for triangle in [[a, b, c], [a, c, b]] {
            for ray in [ahead.with_interval(0.0, 4.0 * size), ahead.with_interval(0.0, size)] {
                let hit = intersect_triangle(&triangle, 0, &ray, HitRule::Touching);
                assert_eq!(hit.map(|hit| hit.t), Some(size), "{size:e}");
            }
            let ray = behind.with_interval(-4.0 * size, 0.0);
            let hit = intersect_triangle(&triangle, 0, &ray, HitRule::Touching);
            assert_eq!(hit.map(|hit| hit.t), Some(-size), "{size:e}");
        }
    }
}

#[test]
fn the_nearer_of_large_triangles_is_the_closest() {
    let size = 2.0_f64.powi(400);
    let ray = Ray::new([0.0; 3], [0.0, 0.0, 1.0]);
    for heights in [[2.0, 1.0], [1.0 + 1e-9, 1.0]] {
        let corner = |x: f64, y: f64, height: f64| [x * size, y * size, height * size];
        let vertices =
            heights.map(|z| [corner(-1.0, -1.0, z), corner(2.0, -1.0, z), corner(-1.0, 2.0, z)]);
        let mesh = TriangleMesh::new(vertices.concat(), vec![[0, 1, 2], [3, 4, 5]]).unwrap();
        let scene = Scene::build(mesh, &BuildOptions::default()).unwrap();
        for hit in [scene.closest_hit(&ray), scene.shapes().closest_hit(&ray)] {
            assert_eq!(hit.map(|hit| hit.t), Some(size), "{heights:?}");
        }
    }
}
