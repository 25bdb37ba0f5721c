//! A ray that begins at a vertex or on an edge did not cross the surface there, while one that begins in a face
//! did: crossings were those of the ray as turned around its origin, which then stays on the edge.

use kdray::{BuildOptions, Ray, Scene};
use kdray_tests::meshes;

/// Whole numbers and halves, so that points on the same line are exact.
const DIRECTIONS: [[f64; 3]; 5] =
    [[0.0, 0.0, 1.0], [1.0, 0.0, -1.0], [1.0, 2.0, 4.0], [-3.0, 1.0, 0.5], [2.0, -2.0, 1.0]];

#[test]
fn crossings_do_not_depend_on_where_on_its_line_a_ray_begins() {
    let scene = Scene::build(meshes::mesh(meshes::boxes(2)), &BuildOptions::default()).unwrap();
    let corners = (0..=4).flat_map(|x| (0..=4).flat_map(move |y| (0..=4).map(move |z| [x, y, z])));
    for origin in corners.map(|p| p.map(|x| 0.5 * f64::from(x))) {
        for direction in DIRECTIONS {
            let line = |back: f64| {
                let origin = std::array::from_fn(|k| origin[k] - back * direction[k]);
                let ray = Ray::new(origin, direction).with_interval(-64.0, 64.0);
                let mut ids: Vec<u32> = scene.all_hits(&ray).map(|hit| hit.primitive_id).collect();
                ids.sort_unstable();
                ids
            };
            let (here, before) = (line(0.0), line(8.0));
            assert_eq!(here, before, "{origin:?} {direction:?}");
            assert_eq!(here.len() % 2, 0, "{origin:?} {direction:?}");
            let ahead = [0.0, f64::NEG_INFINITY].map(|t_min| {
                let ray = Ray::new(origin, direction).with_interval(t_min, f64::INFINITY);
                scene.all_hits(&ray).filter(|hit| hit.t >= 0.0).count()
            });
            assert_eq!(ahead[0], ahead[1], "{origin:?} {direction:?}");
        }
    }
}

#[test]
fn a_ray_from_a_corner_into_a_box_crosses_it_twice() {
    let scene = Scene::build(meshes::mesh(meshes::boxes(1)), &BuildOptions::default()).unwrap();
    let bounds = scene.tree().bounds();
    let corners = [bounds.min, bounds.max].map(|p| p.map(f64::from));
    for corner in 0..8 {
        let [from, to] =
            [corner, 7 - corner].map(|bits| std::array::from_fn(|k| corners[bits >> k & 1][k]));
        let ray = Ray::through(from, to);
        let t: Vec<f64> = scene.all_hits(&ray).map(|hit| hit.t).collect();
        assert_eq!((t.len(), t.first(), t.last()), (2, Some(&0.0), Some(&1.0)), "{ray:?}");
        assert_eq!(scene.count(&ray), 2);
    }
}
