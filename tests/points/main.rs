//! Queries about points: against testing every triangle, and against rational arithmetic.

mod cases;

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
fn the_nearest_point_is_that_of_testing_every_triangle() {
    nearest_points_are_naive(awkward_meshes());
    nearest_points_are_naive(awkward_meshes_in_f64());
}

fn nearest_points_are_naive<T: Precision>(meshes: Vec<(&str, TriangleMesh<T>)>) {
    for (name, mesh) in meshes {
        let points = points(&mesh, 12, 1e14, 21);
        let scenes = scenes_of(&mesh);
        for &point in &points {
            let naive = naive_closest_point(&mesh, point);
            for scene in &scenes {
                assert_eq!(scene.closest_point(point), naive, "{name} {point:?}");
            }
        }
    }
}

#[test]
fn the_distance_is_that_of_rational_arithmetic() {
    distances_are_rational(awkward_meshes());
    distances_are_rational(awkward_meshes_in_f64());
}

/// Triangles from wide ones to such that f64 hardly has, turned anyhow; points over their insides and borders, from next to
/// them to far away.
#[test]
fn the_distance_from_a_slender_triangle_is_that_of_rational_arithmetic() {
    let mut random = random(31);
    let mut unit = |size: f64| [(); 3].map(|()| size * random.random_range(-1.0..1.0));
    for round in 0..20_000 {
        let sine = 2.0_f64.powi(-(round % 49));
        let (a, along, aside) = (unit(0.5), unit(1.0), unit(1.0));
        let (u, v) = (unit(1.0)[0].abs(), unit(1.0)[1].abs());
        let height = 10.0_f64.powf(7.0 * unit(1.0)[0] - 5.0);
        let b = [0, 1, 2].map(|k| a[k] + along[k]);
        let stretch = 0.5 + v;
        let c = [0, 1, 2].map(|k| a[k] + stretch * along[k] + sine * aside[k]);
        let across = |i: usize, j: usize| along[i] * aside[j] - along[j] * aside[i];
        let normal = [across(1, 2), across(2, 0), across(0, 1)];
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        let over = |k: usize| a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]) + height * normal[k];
        let (point, corners) = ([over(0), over(1), over(2)], [a, b, c]);
        let found = closest_on_triangle(point, corners, 0);
        let away = |p: &[f64; 3]| (0..3).map(|k| p[k] - point[k]).fold(0.0, f64::hypot);
        let error = 2.0_f64.powi(-46) * corners.iter().map(away).fold(0.0, f64::max);
        let exact = exact_distance_squared(point, &corners);
        assert!(is_distance(found.distance, error, &exact), "{corners:?} {point:?}: {found:?}");
    }
}

fn distances_are_rational<T: Precision>(meshes: Vec<(&str, TriangleMesh<T>)>) {
    for (name, mesh) in meshes {
        let scene = scene(mesh.clone());
        for point in points(&mesh, 8, 1e6, 22) {
            let Some(found) = scene.closest_point(point) else { continue };
            let ids = 0..mesh.triangles().len() as u32;
            let exact = ids.map(|id| exact_distance_squared(point, &mesh.corners(id))).min();
            let exact = exact.expect("the mesh is not empty");
            let error = 2.0_f64.powi(-46) * farthest_corner(&mesh, point) + f64::from_bits(1);
            assert!(is_distance(found.distance, error, &exact), "{name} {point:?}: {found:?}");
            let is_zero = exact == BigRational::from_integer(0.into());
            assert_eq!(found.distance == 0.0, is_zero, "{name} {point:?}: {found:?}");
            assert_weights(&mesh, point, &found);
        }
    }
}

fn farthest_corner<T: Precision>(mesh: &TriangleMesh<T>, point: [f64; 3]) -> f64 {
    let distance = |p: &[T; 3]| {
        let [x, y, z] = std::array::from_fn(|k| p[k].to_f64() - point[k]);
        x.hypot(y).hypot(z)
    };
    mesh.vertices().iter().map(distance).fold(0.0, f64::max)
}

/// The weights are those of the point that was found.
fn assert_weights<T: Precision>(
    mesh: &TriangleMesh<T>,
    point: [f64; 3],
    found: &kdray::ClosestPoint,
) {
    let [a, b, c] = corners(mesh, found.primitive_id);
    let (u, v) = (found.u, found.v);
    assert!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 + f64::EPSILON, "{point:?}: {found:?}");
    // Both places are rounded to f64.
    let largest = [a, b, c].iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    let error = 2.0_f64.powi(-46) * farthest_corner(mesh, point)
        + 2.0_f64.powi(-50) * largest
        + f64::MIN_POSITIVE * f64::EPSILON;
    for k in 0..3 {
        let place = a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]);
        assert!((place - found.point[k]).abs() <= error, "{point:?}: {found:?}");
    }
}

#[test]
fn closed_meshes_contain_what_rational_arithmetic_says() {
    contain_what_is_inside(closed_meshes(), 15);
    contain_what_is_inside(closed_meshes_in_f64(), 8);
}

fn contain_what_is_inside<T: Precision>(meshes: Vec<(&str, TriangleMesh<T>)>, each: usize) {
    for (name, mesh) in meshes {
        let scenes = scenes_of(&mesh);
        assert!(scenes[0].closure().is_closed(), "{name}");
        let (mut inside, mut outside) = (0, 0);
        for point in points(&mesh, each, 1e14, 31) {
            let expected = exactly_contains(&mesh, point);
            for scene in &scenes {
                assert_eq!(scene.contains(point), expected, "{name} {point:?}");
            }
            *(if expected { &mut inside } else { &mut outside }) += 1;
        }
        let enough = 3 * each;
        assert!(inside > enough && outside > enough, "{name}: {inside} inside, {outside} outside");
    }
}

#[test]
fn signed_distances_are_negative_inside() {
    signs_are_those_of_the_inside(closed_meshes());
    signs_are_those_of_the_inside(closed_meshes_in_f64());
}

fn signs_are_those_of_the_inside<T: Precision>(meshes: Vec<(&str, TriangleMesh<T>)>) {
    for (name, mesh) in meshes {
        let scene = scene(mesh.clone());
        for point in points(&mesh, 10, 1e6, 32) {
            let distance = scene.closest_point(point).expect("the mesh is not empty").distance;
            let expected = match scene.contains(point) {
                true if distance > 0.0 => -distance,
                _ => distance,
            };
            assert_eq!(scene.signed_distance(point), Some(expected), "{name} {point:?}");
        }
    }
}

#[test]
fn open_meshes_wind_as_the_sum_over_their_triangles() {
    // Spheres without some of their triangles, and what has no inside at all.
    let mut open = sphere(40);
    let kept = open.triangles()[300..].to_vec();
    open = TriangleMesh::new(open.vertices().to_vec(), kept).expect("parts are valid");
    let soup = mesh(soup(400, [0.0; 3], 1.0, 3));
    let all = [("sphere", open), ("soup", soup), ("grid", mesh(grid(20, 1)))];
    winds_as_the_sum(&all);
    let of_many_digits = |(name, mesh): (_, TriangleMesh)| (name, moved(&mesh, of_many_digits));
    winds_as_the_sum(&all.clone().map(of_many_digits));
    winds_as_the_sum(&all.clone().map(|(name, mesh)| (name, moved(&mesh, far_away))));
    let scaled = |by: f64| [("soup", moved(&all[1].1, |p| p.map(|x| x * by)))];
    winds_as_the_sum(&scaled(1e290));
    winds_as_the_sum(&scaled(1e-300));
}

fn winds_as_the_sum<T: Precision>(meshes: &[(&str, TriangleMesh<T>)]) {
    for (name, mesh) in meshes {
        let scene = scene(mesh.clone());
        assert_eq!(scene.closure(), Closure::Open, "{name}");
        for point in points(mesh, 20, 1e6, 41) {
            let (found, sum) = (scene.winding_number(point), naive_winding_number(mesh, point));
            assert!((found - sum).abs() < WINDING_ERROR, "{name} {point:?}: {found} {sum}");
        }
    }
}

/// More than the 0.006 that was measured.
const WINDING_ERROR: f64 = 0.01;

#[test]
fn the_sides_of_an_open_mesh_are_told_apart_one_step_off_its_surface() {
    let mut lid = sphere(20);
    lid = TriangleMesh::new(lid.vertices().to_vec(), lid.triangles()[..700].to_vec()).unwrap();
    sides_are_told_apart(&moved(&lid, far_away));
    sides_are_told_apart(&lid);
}

fn sides_are_told_apart<T: Precision>(lid: &TriangleMesh<T>) {
    let scene = scene(lid.clone());
    assert_eq!(scene.closure(), Closure::Open);
    let (mut random, mut seen) = (random(42), [0; 3]);
    for _ in 0..100 {
        let id = random.random_range(0..400);
        let [a, b, c] = corners(lid, id);
        let on: [f64; 3] = std::array::from_fn(|k| 0.25 * a[k] + 0.25 * b[k] + 0.5 * c[k]);
        for point in beside(&on).into_iter().chain([on]) {
            let side = side_of_plane(point, [a, b, c]);
            assert_eq!(scene.contains(point), side != Ordering::Greater, "{point:?} {side:?}");
            seen[(side as i8 + 1) as usize] += 1;
        }
    }
    assert!(seen[0] > 100 && seen[2] > 100, "{seen:?}");
}

#[test]
fn oriented_meshes_wind_a_whole_number_of_times() {
    let nested = closed_meshes().pop().expect("there are meshes").1;
    let scene = scene(nested.clone());
    for (point, number, inside) in [
        ([0.5, 0.5, 0.5], 2.0, false),
        ([0.1, 0.5, 0.5], 1.0, true),
        ([2.0, 0.5, 0.5], 0.0, false),
        ([0.25_f64.next_up(), 0.5, 0.4], 2.0, false),
        ([0.25_f64.next_down(), 0.5, 0.4], 1.0, true),
    ] {
        let found = scene.winding_number(point);
        assert_eq!((found, scene.contains(point)), (number, inside), "{point:?}");
        let sum = (0..24).map(|id| solid_angle(point, corners(&nested, id))).sum::<f64>();
        assert!((found - sum).abs() < 1e-9, "{point:?}: {found} {sum}");
    }
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
fn points_see_each_other_where_rational_arithmetic_says_so() {
    sights_are_rational(awkward_meshes());
    sights_are_rational(awkward_meshes_in_f64());
}

fn sights_are_rational<T: Precision>(meshes: Vec<(&str, TriangleMesh<T>)>) {
    let (mut seen, mut hidden) = (0, 0);
    for (name, mesh) in meshes {
        if T::FITS_TREE && ["empty", "huge", "tiny"].contains(&name) {
            continue;
        }
        let scene = scene(mesh.clone());
        let mut archer = Archer::new(&mesh, 61);
        for (index, ray) in archer.all_kinds(8, 10.0).into_iter().enumerate() {
            // Half of them on a grid that is fine enough to meet surfaces; the others are such that the way between
            // them is rounded.
            let placed =
                |p: [f64; 3]| if index % 2 == 0 { p.map(|x| archer.rounded(x)) } else { p };
            let (from, to) = (placed(ray.origin), placed(ray.at(1.0)));
            let way = (0..3).map(|k| to[k] - from[k]);
            if !way.chain(from).chain(to).all(f64::is_finite) {
                continue;
            }
            let expected = is_exactly_visible(&mesh, from, to);
            assert_eq!(scene.visible(from, to), expected, "{name} {from:?} {to:?}");
            assert_eq!(scene.visible(to, from), expected, "{name} {to:?} {from:?}");
            *(if expected { &mut seen } else { &mut hidden }) += 1;
        }
    }
    assert!(seen > 100 && hidden > 100, "{seen} seen, {hidden} hidden");
}

#[test]
fn hits_go_on_after_any_of_them() {
    hits_go_on(awkward_meshes());
    hits_go_on(awkward_meshes_in_f64());
}

fn hits_go_on<T: Precision>(meshes: Vec<(&str, TriangleMesh<T>)>) {
    for (name, mesh) in meshes {
        let scene = scene(mesh.clone());
        for ray in Archer::new(&mesh, 71).all_kinds(6, 10.0) {
            let (crossed, touched): (Vec<_>, Vec<_>) =
                (scene.all_hits(&ray).collect(), scene.all_touched(&ray).collect());
            for (i, hit) in crossed.iter().enumerate() {
                let rest: Vec<_> = scene.all_hits_after(&ray, hit).collect();
                assert_eq!(rest, crossed[i + 1..], "{name} {ray:?}");
            }
            for (i, hit) in touched.iter().enumerate() {
                let rest: Vec<_> = scene.all_touched_after(&ray, hit).collect();
                assert_eq!(rest, touched[i + 1..], "{name} {ray:?}");
            }
        }
    }
}

#[test]
fn the_first_hit_of_those_that_are_kept() {
    first_hits_are_kept(awkward_meshes());
    first_hits_are_kept(awkward_meshes_in_f64());
}

fn first_hits_are_kept<T: Precision>(meshes: Vec<(&str, TriangleMesh<T>)>) {
    for (name, mesh) in meshes {
        let scene = scene(mesh.clone());
        for ray in Archer::new(&mesh, 72).all_kinds(6, 10.0) {
            let all = scene.shapes().naive().all_hits(&ray, HitRule::Touching);
            let keeps: [fn(&Hit) -> bool; 4] = [
                |_| true,
                |_| false,
                |hit| hit.primitive_id % 3 == 1,
                |hit| hit.side == Side::Front && hit.t > 0.5,
            ];
            for keep in keeps {
                let expected = all.iter().copied().find(keep);
                let mut asked = Vec::new();
                let found = scene.closest_hit_where(&ray, |hit| {
                    asked.push(*hit);
                    keep(hit)
                });
                assert_eq!(found, expected, "{name} {ray:?}");
                assert_eq!(asked, all[..asked.len()], "{name} {ray:?}");
                assert_eq!(scene.any_hit_where(&ray, keep), expected.is_some());
            }
        }
    }
}

#[test]
fn a_box_is_as_thick_as_it_is_long() {
    // Not at zero, so that points on it are rounded.
    let moved = boxes(1).into_iter().map(|t| t.map(|p| p.map(|x| 0.1 + 3.0 * x)));
    let mesh = mesh(moved.collect());
    let scene = scene(mesh.clone());
    for id in 0..12 {
        let normal = mesh.geometric_normal(id);
        let [a, _, _] = corners(&mesh, id);
        let outward: f64 = (0..3).map(|k| normal[k] * (a[k] - 1.6)).sum();
        let sides = [Side::Front, Side::Back];
        let [outside, inside] = if outward > 0.0 { sides } else { [sides[1], sides[0]] };
        let found = scene.thickness(id, 0.3, 0.3, outside).expect("a box is closed");
        assert!((found - 3.0).abs() < 1e-6, "{id}: {found}");
        assert_eq!(scene.thickness(id, 0.3, 0.3, inside), None, "{id}");
    }
}

#[test]
fn neighbours_at_an_edge_or_a_corner_are_not_met_at_the_start() {
    let round = sphere(20);
    let moved = round.vertices().iter().map(|p| p.map(|x| 0.1 + 3.0 * x)).collect();
    thick_at_the_rims(&TriangleMesh::new(moved, round.triangles().to_vec()).unwrap(), (1.0, 7));
    let scaled = |by: f64| move |p: [f64; 3]| p.map(|x| (0.1 + 3.0 * x) * by);
    for size in [1e-300, 1.0, 1e290] {
        thick_at_the_rims(&self::moved(&round, scaled(size)), (size, 97));
    }
}

fn thick_at_the_rims<T: Precision>(round: &TriangleMesh<T>, (size, step): (f64, usize)) {
    let scene = scene(round.clone());
    let places = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.3, 0.0), (0.0, 0.6), (0.3, 0.7)];
    for id in (0..round.triangles().len() as u32).step_by(step) {
        for (u, v) in places {
            let found = scene.thickness(id, u, v, Side::Front).expect("a sphere is closed");
            assert!((5.5..6.1).contains(&(found / size)), "{id} {u} {v}: {found}");
            assert_eq!(scene.thickness(id, u, v, Side::Back), None, "{id} {u} {v}");
        }
    }
}

#[test]
fn a_hit_and_a_nearest_point_tell_where_to_measure() {
    let scene = scene(sphere(30));
    let ray = Ray::through([3.0, 1.0, 0.5], [0.1, 0.0, 0.0]);
    let hit = scene.closest_hit(&ray).expect("the sphere is ahead");
    let near = scene.closest_point(ray.origin).expect("there is a sphere");
    let thick = scene.thickness(hit.primitive_id, hit.u, hit.v, hit.side).expect("it is closed");
    let from_near = scene.thickness(near.primitive_id, near.u, near.v, Side::Front);
    assert!((thick - 2.0).abs() < 0.1, "{thick}");
    assert!((from_near.expect("it is closed") - 2.0).abs() < 0.1, "{from_near:?}");
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
