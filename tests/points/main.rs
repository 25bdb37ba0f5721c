//! Queries about points: against testing every triangle, and against rational arithmetic.

mod cases;
mod hits;
mod inside;
mod nearest;
mod sights;

use cases::{
    awkward_meshes, awkward_meshes_in_f64, closed_meshes, closed_meshes_in_f64, far_away,
    of_many_digits,
};
use kdray::exact::side_of_plane;
use kdray::primitives::{HitRule, closest_on_triangle, solid_angle};
use kdray::{BuildOptions, Closure, Hit, Precision, Ray, Scene, Side, Strategy, TriangleMesh};
use kdray_tests::closed::closed_part;
use kdray_tests::meshes::{boxes, grid, mesh, mesh_in_f64, moved, soup, sphere, torus};
use kdray_tests::oracle::{
    exact_distance_squared, exactly_contains, is_distance, is_exactly_visible,
};
use kdray_tests::points::{beside, corners, naive_closest_point, naive_winding_number, points};
use kdray_tests::rays::{Archer, random};
use kdray_tests::shared::{load_mesh, scenes};
use num_rational::BigRational;
use rand::RngExt;
use std::cmp::Ordering;

/// Every way to build a tree, and the default for the kernels.
fn scenes_of<T: Precision>(mesh: &TriangleMesh<T>) -> Vec<Scene<T>> {
    let strategies = Strategy::ALL.map(BuildOptions::for_strategy);
    let options = strategies.into_iter().chain([BuildOptions::default()]);
    options.map(|options| Scene::build(mesh.clone(), &options).expect("a small mesh")).collect()
}

fn scene<T: Precision>(mesh: TriangleMesh<T>) -> Scene<T> {
    Scene::build(mesh, &BuildOptions::default()).expect("the mesh is valid")
}

#[test]
fn bad_points_have_documented_answers() {
    bad_points_are_answered(sphere(5));
    bad_points_are_answered(moved(&sphere(5), of_many_digits));
}

fn bad_points_are_answered<T: Precision>(round: TriangleMesh<T>) {
    let scene = scene(round);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let point = [0.0, bad, 0.0];
        assert!(!scene.contains(point) && scene.winding_number(point).is_nan());
        assert!(scene.closest_point(point).is_none() && scene.signed_distance(point).is_none());
        assert!(!scene.visible(point, [0.0; 3]) && !scene.visible([0.0; 3], point));
        assert!(!scene.visible(point, point));
    }
    for far in [1e151, 1e200, f64::MAX] {
        let found = scene.signed_distance([far, -far, 0.0]).expect("the point is finite");
        assert!(found >= far && !scene.contains([far; 3]), "{found}");
        assert!(!scene.visible([far; 3], [-far; 3]), "the sphere is between");
    }
    assert_eq!(scene.thickness(u32::MAX, 0.2, 0.2, Side::Front), None);
    for (u, v) in [(f64::NAN, 0.0), (-0.5, 0.5), (0.7, 0.7), (f64::INFINITY, 0.0)] {
        assert_eq!(scene.thickness(0, u, v, Side::Front), None, "{u} {v}");
    }
    let empty = self::scene(TriangleMesh::<T>::default());
    assert!(!empty.contains([0.0; 3]) && empty.closest_point([0.0; 3]).is_none());
    assert_eq!(empty.winding_number([0.0; 3]), 0.0);
    assert!(empty.visible([0.0; 3], [1.0; 3]));
}

#[test]
fn many_points_are_answered_like_each_alone_on_any_number_of_threads() {
    let open = mesh(soup(300, [0.0; 3], 1.0, 9));
    for mesh in [torus(12, 8), open] {
        many_are_like_each(&moved(&mesh, far_away));
        many_are_like_each(&mesh);
    }
}

fn many_are_like_each<T: Precision>(mesh: &TriangleMesh<T>) {
    let scene = scene(mesh.clone());
    let points = points(mesh, 20, 100.0, 81);
    let alone: Vec<_> = points.iter().map(|&p| scene.closest_point(p)).collect();
    let inside: Vec<_> = points.iter().map(|&p| scene.contains(p)).collect();
    let signed: Vec<_> = points.iter().map(|&p| scene.signed_distance(p)).collect();
    let winding: Vec<_> = points.iter().map(|&p| scene.winding_number(p)).collect();
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let count = points.len();
        let (mut a, mut b) = (vec![None; count], vec![false; count]);
        let (mut c, mut d) = (vec![None; count], vec![0.0; count]);
        pool.install(|| {
            scene.par_closest_points(&points, &mut a);
            scene.par_contains_each(&points, &mut b);
            scene.par_signed_distances(&points, &mut c);
            scene.par_winding_numbers(&points, &mut d);
        });
        assert!(a == alone && b == inside && c == signed && d == winding, "{threads}");
    }
    let (mut a, mut b) = (vec![None; points.len()], vec![false; points.len()]);
    let (mut c, mut d) = (vec![None; points.len()], vec![0.0; points.len()]);
    scene.closest_points(&points, &mut a);
    scene.contains_each(&points, &mut b);
    scene.signed_distances(&points, &mut c);
    scene.winding_numbers(&points, &mut d);
    assert!(a == alone && b == inside && c == signed && d == winding);
}

/// All that a scene says of points, as bits.
fn answers<T: Precision>(scene: &Scene<T>, points: &[[f64; 3]]) -> Vec<[u64; 8]> {
    let answer = |(i, &point): (usize, &[f64; 3])| {
        let near = scene.closest_point(point).expect("there are triangles");
        let thickness = scene.thickness(near.primitive_id, near.u, near.v, Side::Front);
        [
            near.distance.to_bits(),
            near.u.to_bits(),
            near.v.to_bits(),
            u64::from(near.primitive_id),
            scene.signed_distance(point).map_or(0, f64::to_bits),
            scene.winding_number(point).to_bits(),
            thickness.map_or(0, f64::to_bits),
            u64::from(scene.contains(point)) + 2 * u64::from(scene.visible(point, points[i / 2])),
        ]
    };
    points.iter().enumerate().map(answer).collect()
}

#[test]
fn meshes_of_f32_numbers_answer_alike_in_f64() {
    for (name, mesh) in awkward_meshes().into_iter().chain(closed_meshes()) {
        if mesh.triangles().is_empty() {
            continue;
        }
        let points = points(&mesh, 8, 1e14, 95);
        let in_f64 = scene(mesh_in_f64(&mesh));
        assert_eq!(in_f64.closure(), scene(mesh.clone()).closure(), "{name}");
        assert_eq!(answers(&in_f64, &points), answers(&scene(mesh), &points), "{name}");
    }
}

/// Scenes beside the checkout: the nearest points of all, and what their closed parts contain.
#[test]
fn real_scenes_answer_like_every_triangle() {
    for info in scenes().into_iter().flatten() {
        if info.triangles > 40_000 {
            continue;
        }
        let mesh = load_mesh(&info).expect("the scene loads");
        let whole = scene(mesh.clone());
        for point in points(&mesh, 1, 100.0, 91) {
            let naive = naive_closest_point(&mesh, point);
            assert_eq!(whole.closest_point(point), naive, "{} {point:?}", info.name);
        }
        let closed = closed_part(&mesh);
        if closed.triangles().is_empty() {
            continue;
        }
        let part = scene(closed.clone());
        assert_eq!(part.closure(), Closure::Oriented, "{}", info.name);
        for point in points(&closed, 1, 100.0, 92) {
            let expected = exactly_contains(&closed, point);
            assert_eq!(part.contains(point), expected, "{} {point:?}", info.name);
        }
    }
}
