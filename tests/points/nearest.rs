//! Nearest points, against testing every triangle and rational arithmetic.

use super::*;

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
