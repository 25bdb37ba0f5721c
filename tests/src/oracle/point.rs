//! A point and a triangle.

use super::integers::{Vector, integers, ratio, rational};
use super::triangle::{exact_touch_between, exact_triangle_hit};
use kdray::primitives::HitRule::Crossing;
use kdray::{Coordinate, Ray, TriangleMesh};
use num_bigint::Sign;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// The square of the distance from a point to a closed triangle, which may have no area.
pub fn exact_distance_squared<T: Coordinate>(
    point: [f64; 3],
    corners: &[[T; 3]; 3],
) -> BigRational {
    let [a, b, c] = corners.map(|p| p.map(T::to_f64));
    // The unit goes along, so that the integers have a known size.
    let [a, b, c, p, unit] = integers([a, b, c, point, [1.0, 0.0, 0.0]]);
    let unit = unit.0[0].clone();
    let squared = to_plane(&p, [&a, &b, &c]).unwrap_or_else(|| {
        let edges = [(&a, &b), (&b, &c), (&c, &a)];
        let distances = edges.map(|(from, to)| to_segment(&p, from, to));
        distances.into_iter().min().expect("there are three")
    });
    squared / (&unit * &unit)
}

/// The squared distance to the plane, if the foot of the perpendicular is in the triangle.
fn to_plane(p: &Vector<3>, [a, b, c]: [&Vector<3>; 3]) -> Option<BigRational> {
    let normal = b.minus(a).cross(&c.minus(a));
    let inside = |from: &Vector<3>, to: &Vector<3>| {
        let side = to.minus(from).cross(&p.minus(from)).dot(&normal);
        side.sign() != Sign::Minus
    };
    let length_squared = normal.dot(&normal);
    let is_foot_inside = inside(a, b) && inside(b, c) && inside(c, a);
    (is_foot_inside && !length_squared.is_zero()).then(|| {
        let height = normal.dot(&p.minus(a));
        ratio(&height * &height, length_squared)
    })
}

fn to_segment(p: &Vector<3>, a: &Vector<3>, b: &Vector<3>) -> BigRational {
    let (edge, from_a, from_b) = (b.minus(a), p.minus(a), p.minus(b));
    if !from_a.dot(&edge).is_positive() {
        return BigRational::from(from_a.dot(&from_a));
    }
    if !from_b.dot(&edge).is_negative() {
        return BigRational::from(from_b.dot(&from_b));
    }
    let across = edge.cross(&from_a);
    ratio(across.dot(&across), edge.dot(&edge))
}

/// Whether a point is inside a closed mesh, or on its surface: by an odd number of crossings, or by
/// a distance of zero.
pub fn exactly_contains<T: Coordinate>(mesh: &TriangleMesh<T>, point: [f64; 3]) -> bool {
    let ids = 0..mesh.triangles().len() as u32;
    let ray = Ray::new(point, [0.25, 0.5, 1.0]);
    let is_crossed = |&id: &u32| {
        let hit = exact_triangle_hit(&mesh.corners(id), id, &ray, Crossing);
        hit.is_some_and(|hit| hit.t.is_positive())
    };
    let is_on = |id| exact_distance_squared(point, &mesh.corners(id)).is_zero();
    ids.clone().filter(is_crossed).count() % 2 == 1 || ids.into_iter().any(is_on)
}

/// Whether a distance is right up to `error`.
pub fn is_distance(found: f64, error: f64, squared: &BigRational) -> bool {
    let (found, error) = (rational(found), rational(error));
    let (low, high) = (&found - &error, &found + &error);
    (low.is_negative() || &low * &low <= *squared) && *squared <= &high * &high
}

/// Whether no triangle that a line meets is strictly between two points of it: their difference need not be an f64.
pub fn is_exactly_visible<T: Coordinate>(
    mesh: &TriangleMesh<T>,
    from: [f64; 3],
    to: [f64; 3],
) -> bool {
    (0..mesh.triangles().len() as u32).all(|id| !is_between(&mesh.corners(id), from, to))
}

/// Whether a triangle is strictly between two points.
pub fn is_between<T: Coordinate>(corners: &[[T; 3]; 3], from: [f64; 3], to: [f64; 3]) -> bool {
    let hit = exact_touch_between(corners, 0, from, to);
    hit.is_some_and(|hit| hit.t.is_positive() && hit.t < BigRational::one())
}
