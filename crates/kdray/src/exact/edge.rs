//! Edge functions, exactly.

use super::Accumulator;
use super::accumulator::ShortAccumulator;
use super::lattice::{cross_component_sign, minus, on_long_lattice, triple_product};
use crate::geometry::Ray;
use std::cmp::Ordering;

/// The edges of W, U and V: each runs opposite a, b and c.
pub fn directed_edges<P: Copy>([a, b, c]: [P; 3]) -> [(P, P); 3] {
    [(b, c), (c, a), (a, b)]
}

/// d · (q' x p') with p' = p − o: on which side of the edge (p, q) the line of the ray passes.
#[inline]
pub fn edge_function(ray: &Ray<3>, p: [f64; 3], q: [f64; 3]) -> Accumulator {
    // q' x p' = q x p + p x o + o x q
    let (o, d) = (ray.origin, ray.direction);
    let mut sum = Accumulator::default();
    for (a, b) in [(q, p), (p, o), (o, q)] {
        add_triple_product(&mut sum, d, a, b);
    }
    sum
}

/// T = −a' · (b' x c'), six times the volume that the triangle spans with the ray's origin.
pub fn volume(origin: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> Accumulator {
    // a' · (b' x c') = a·(b x c) − o·(b x c) − o·(c x a) − o·(a x b)
    let mut sum = Accumulator::default();
    add_triple_product(&mut sum, a, c, b);
    for (p, q) in [(b, c), (c, a), (a, b)] {
        add_triple_product(&mut sum, origin, p, q);
    }
    sum
}

/// The sign of [`volume`].
pub(super) fn volume_sign(origin: [f64; 3], corners: [[f64; 3]; 3]) -> Ordering {
    match short_volume(origin, corners) {
        Some(volume) => volume.sign(),
        None => volume(origin, corners).sign(),
    }
}

/// [`volume`], unless sizes are too different or out of the ordinary.
pub(super) fn short_volume(origin: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> Option<ShortAccumulator> {
    let ([o, a, b, c], unit) = on_long_lattice([origin, a, b, c])?;
    Some(triple_product(minus(a, o), minus(c, o), minus(b, o), 3 * unit))
}

/// Adds a · (b x c).
fn add_triple_product(sum: &mut Accumulator, a: [f64; 3], b: [f64; 3], c: [f64; 3]) {
    for (i, a) in a.into_iter().enumerate() {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        sum.add([a, b[j], c[k]]);
        sum.subtract([a, b[k], c[j]]);
    }
}

/// (q_j − p_j) d_k − (q_k − p_k) d_j.
pub(super) fn crossed_component(
    d: [f64; 3],
    p: [f64; 3],
    q: [f64; 3],
    (j, k): (usize, usize),
) -> Accumulator {
    let mut sum = Accumulator::default();
    sum.add([q[j], d[k], 1.0]);
    sum.subtract([p[j], d[k], 1.0]);
    sum.subtract([q[k], d[j], 1.0]);
    sum.add([p[k], d[j], 1.0]);
    sum
}

/// a'_i b'_j − a'_j b'_i with a' = a − o and b' = b − o: the component of a' x b' that is
/// perpendicular to the axes i and j.
pub fn cross_component<const K: usize>(
    o: [f64; K],
    a: [f64; K],
    b: [f64; K],
    (i, j): (usize, usize),
) -> Accumulator {
    let mut sum = Accumulator::default();
    for (p, q) in [(a, b), (b, o), (o, a)] {
        sum.add([p[i], q[j], 1.0]);
        sum.subtract([p[j], q[i], 1.0]);
    }
    sum
}

/// The sign of [`cross_component`].
pub(super) fn cross_sign(o: [f64; 3], a: [f64; 3], b: [f64; 3], plane: (usize, usize)) -> Ordering {
    match on_long_lattice([o, a, b]) {
        Some(([o, a, b], _)) => cross_component_sign(minus(a, o), minus(b, o), plane),
        None => cross_component(o, a, b, plane).sign(),
    }
}

/// In 2-D: d x p', on which side of the line of the ray the point p lies.
pub fn side_of_ray(ray: &Ray<2>, p: [f64; 2]) -> Accumulator {
    let (o, d) = (ray.origin, ray.direction);
    let mut sum = Accumulator::default();
    sum.add([d[0], p[1], 1.0]);
    sum.subtract([d[0], o[1], 1.0]);
    sum.subtract([d[1], p[0], 1.0]);
    sum.add([d[1], o[0], 1.0]);
    sum
}

/// In 2-D: the sign of d x p' for the moved ray (see [`crate::exact`]), which no point is on. `sign` is that
/// for the ray as it is.
pub fn moved_side_sign(ray: &Ray<2>, sign: Ordering) -> Ordering {
    // Moved by s, d x p' loses d x s: of s = (ε, ε²), that is d_x ε² − d_y ε.
    let [x, y] = ray.direction.map(|d| d.partial_cmp(&0.0).unwrap_or(Ordering::Equal));
    sign.then(y).then(x.reverse())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_that_the_ray_meets_has_edge_function_zero() {
        let ray = Ray::new([0.0, 0.0, -1.0], [0.0, 0.0, 1.0]);
        let (p, q) = ([-1.0, 0.0, 5.0], [1e17, 0.0, 3.0]);
        assert_eq!(edge_function(&ray, p, q).sign(), Ordering::Equal);
        let q = [1e17, f64::from_bits(1), 3.0];
        assert_eq!(edge_function(&ray, p, q).sign(), Ordering::Greater);
        assert_eq!(edge_function(&ray, q, p).sign(), Ordering::Less);
    }

    #[test]
    fn the_volume_is_zero_for_an_origin_in_the_plane() {
        let triangle = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert_eq!(volume([0.25, 0.25, 0.5], triangle).sign(), Ordering::Equal);
        assert_eq!(volume([0.0; 3], triangle).sign(), Ordering::Less);
        assert_eq!(volume([1.0; 3], triangle).sign(), Ordering::Greater);
    }
}
