//! What is said of a point, by rational arithmetic: that testing every triangle gives the same says nothing of the
//! test.

use crate::closed::is_closed;
use crate::oracle::{exact_distance_squared, exactly_contains, is_distance, is_exactly_visible};
use crate::points::corners;
use kdray::{ClosestPoint, Coordinate, Precision, Scene, TriangleMesh};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

/// What a distance may be off by, over that to the triangle's farthest corner: as is documented of the thinnest ones.
const DISTANCE_ERROR: f64 = 1.0 / (1_u64 << 44) as f64;

/// The smallest f64, by which what is near it may be off.
const SMALLEST: f64 = f64::from_bits(1);

/// The nearest point, whether the mesh holds the point, and whether it is seen from another one.
///
/// # Panics
/// If any of it is wrong.
pub(super) fn check<T: Precision>(scene: &Scene<T>, other: [f64; 3], point: [f64; 3]) {
    let mesh = scene.mesh();
    check_nearest(mesh, point, scene.closest_point(point));
    let closed = is_closed(mesh);
    assert_eq!(scene.closure().is_closed(), closed, "closed: {closed}");
    if closed {
        assert_eq!(scene.contains(point), exactly_contains(mesh, point), "{point:?}");
    }
    check_visible(mesh, [other, point], scene.visible(other, point));
}

fn check_visible<T: Coordinate>(
    mesh: &TriangleMesh<T>,
    [from, to]: [[f64; 3]; 2],
    is_visible: bool,
) {
    let are_near = (0..3).all(|k| (to[k] - from[k]).is_finite());
    let expected = are_near && is_exactly_visible(mesh, from, to);
    assert_eq!(is_visible, expected, "{from:?} {to:?}");
}

/// No triangle is nearer, the named one is as near, and at the named place.
fn check_nearest<T: Coordinate>(
    mesh: &TriangleMesh<T>,
    point: [f64; 3],
    nearest: Option<ClosestPoint>,
) {
    let Some(nearest) = nearest else {
        assert!(mesh.triangles().is_empty(), "{point:?}: nothing is the nearest");
        return;
    };
    let mut is_on_surface = false;
    for id in 0..mesh.triangles().len() as u32 {
        let corners = corners(mesh, id);
        let squared = exact_distance_squared(point, &corners);
        is_on_surface |= squared.is_zero();
        let error = error(point, &corners);
        let is_so_far = may_be_as_far(nearest.distance, error, &squared);
        assert!(is_so_far, "{point:?}: triangle {id} is nearer than {nearest:?}");
        if id == nearest.primitive_id {
            assert!(is_at(nearest.distance, error, &squared), "{point:?}: {nearest:?}");
            check_place(point, &corners, &nearest, error);
        }
    }
    assert_eq!(nearest.distance == 0.0, is_on_surface, "{point:?}: {nearest:?}");
}

/// The place is one of the triangle, and as far away as is said, but for what rounding its coordinates does.
fn check_place(point: [f64; 3], corners: &[[f64; 3]; 3], nearest: &ClosestPoint, error: f64) {
    let numbers = corners.iter().flatten().chain(&point);
    let largest = numbers.fold(0.0_f64, |most, x| most.max(x.abs()));
    let error = error + 8.0 * (f64::EPSILON * largest + SMALLEST);
    let off = exact_distance_squared(nearest.point, corners);
    assert!(is_distance(0.0, error, &off), "{point:?}: {nearest:?} is off the triangle");
    let way = exact_distance_squared(point, &[nearest.point; 3]);
    let is_as_far = is_at(nearest.distance, 2.0 * error, &way);
    assert!(is_as_far, "{point:?}: the place of {nearest:?} is elsewhere");
}

/// What the distance to a triangle may be off by.
fn error(point: [f64; 3], corners: &[[f64; 3]; 3]) -> f64 {
    let away = |p: &[f64; 3]| (0..3).map(|k| p[k] - point[k]).fold(0.0, f64::hypot);
    let farthest = corners.iter().map(away).fold(0.0, f64::max);
    DISTANCE_ERROR * farthest.min(f64::MAX) + SMALLEST
}

/// Whether a distance is right; the last f64 stands for all that are farther.
fn is_at(found: f64, error: f64, squared: &BigRational) -> bool {
    is_distance(found, error, squared) || found == f64::MAX && may_be_as_far(found, error, squared)
}

/// Whether a distance is not too large.
fn may_be_as_far(found: f64, error: f64, squared: &BigRational) -> bool {
    let [found, error] = [found, error].map(BigRational::from_float);
    let least = found.zip(error).map(|(found, error)| found - error);
    least.is_some_and(|least| !least.is_positive() || &least * &least <= *squared)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshes::torus;
    use kdray::BuildOptions;

    const POINT: [f64; 3] = [0.3, -1.25, 0.7];

    fn scene() -> Scene {
        Scene::build(torus(7, 5), &BuildOptions::default()).unwrap()
    }

    fn check_spoilt(spoil: impl Fn(&mut ClosestPoint)) {
        let scene = scene();
        let mut nearest = scene.closest_point(POINT).unwrap();
        spoil(&mut nearest);
        check_nearest(scene.mesh(), POINT, Some(nearest));
    }

    #[test]
    fn right_answers_are_found_right() {
        check_spoilt(|_| {});
        let scene = scene();
        for point in [POINT, [1.0, 0.0, 0.0], [1e300, -1e308, f64::MAX], [5e-324, 0.0, 0.0]] {
            check(&scene, POINT, point);
        }
    }

    #[test]
    #[should_panic(expected = "is nearer")]
    fn a_distance_that_is_too_large_is_found() {
        check_spoilt(|nearest| nearest.distance *= 1.0 + 1e-12);
    }

    #[test]
    #[should_panic(expected = "ClosestPoint")]
    fn a_distance_that_is_too_small_is_found() {
        check_spoilt(|nearest| nearest.distance *= 1.0 - 1e-12);
    }

    #[test]
    #[should_panic(expected = "off the triangle")]
    fn a_place_above_the_triangle_is_found() {
        check_spoilt(|nearest| nearest.point[2] += 1e-9);
    }

    #[test]
    #[should_panic(expected = "left")]
    fn a_point_that_is_not_seen_is_found() {
        let scene = scene();
        let ends = [POINT, [-3.0, 1.25, -0.7]];
        check_visible(scene.mesh(), ends, !scene.visible(ends[0], ends[1]));
    }
}
