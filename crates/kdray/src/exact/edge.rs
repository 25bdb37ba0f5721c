//! Edge functions, exactly.

use super::Accumulator;
use super::accumulator::ShortAccumulator;
use super::lattice::{
    cross_component_sign, minus, on_lattice, on_long_lattice, sign_of_products, triple_product,
};
use crate::geometry::Ray;
use std::cmp::Ordering;

/// The edges of W, U and V: each runs opposite a, b and c.
pub fn directed_edges<P: Copy>([a, b, c]: [P; 3]) -> [(P, P); 3] {
    [(b, c), (c, a), (a, b)]
}

/// d · (q' x p') with p' = p − o: on which side of the edge (p, q) the line of the ray passes.
pub fn edge_function(ray: &Ray<3>, p: [f64; 3], q: [f64; 3]) -> Accumulator {
    // q' x p' = q x p + p x o + o x q
    let (o, d) = (ray.origin, ray.direction);
    let mut sum = Accumulator::default();
    for (a, b) in [(q, p), (p, o), (o, q)] {
        add_triple_product(&mut sum, d, a, b);
    }
    sum
}

/// The sign of [`edge_function`].
pub fn edge_sign(ray: &Ray<3>, p: [f64; 3], q: [f64; 3]) -> Ordering {
    let in_integers = || {
        let d = on_lattice(ray.direction)?;
        let [p, q] = around_origin(ray.origin, p, q)?;
        let minor = |i: usize, j: usize| q[i] * p[j] - q[j] * p[i];
        let pairs = [(d[0], minor(1, 2)), (d[1], minor(2, 0)), (d[2], minor(0, 1))];
        Some(sign_of_products(pairs))
    };
    let in_long_integers = || Some(short_edge_function(ray, p, q)?.sign());
    let sign = in_integers().or_else(in_long_integers);
    sign.unwrap_or_else(|| edge_function(ray, p, q).sign())
}

/// [`edge_function`], unless sizes are too different or out of the ordinary.
fn short_edge_function(ray: &Ray<3>, p: [f64; 3], q: [f64; 3]) -> Option<ShortAccumulator> {
    let ([d], direction_unit) = on_long_lattice([ray.direction])?;
    let ([o, p, q], unit) = on_long_lattice([ray.origin, p, q])?;
    Some(triple_product(d, minus(q, o), minus(p, o), direction_unit + 2 * unit))
}

/// p' and q' in the same integer proportions; `None` if the numbers have too many digits.
fn around_origin(o: [f64; 3], p: [f64; 3], q: [f64; 3]) -> Option<[[i128; 3]; 2]> {
    let all = on_lattice([o[0], o[1], o[2], p[0], p[1], p[2], q[0], q[1], q[2]])?;
    let from_origin = |first: usize| [0, 1, 2].map(|k| i128::from(all[first + k] - all[k]));
    Some([from_origin(3), from_origin(6)])
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

/// The sign of the edge function of (p, q) for the moved ray (see [`crate::exact`]); `Equal` only if the edge
/// is parallel to the ray, or has no length. `sign` is that of the edge function for the ray as it is.
pub fn moved_edge_sign(ray: &Ray<3>, p: [f64; 3], q: [f64; 3], sign: Ordering) -> Ordering {
    if sign != Ordering::Equal {
        return sign;
    }
    match on_lattice(ray.direction).zip(around_origin(ray.origin, p, q)) {
        Some((d, [p, q])) => {
            let d = d.map(i128::from);
            first_sign(|(j, k)| ((q[j] - p[j]) * d[k]).cmp(&((q[k] - p[k]) * d[j])))
        }
        None => sign_along(ray.direction, p, q),
    }
}

/// The sign of (q − p) x d: see [`first_sign`].
fn sign_along(direction: [f64; 3], p: [f64; 3], q: [f64; 3]) -> Ordering {
    match on_long_lattice([direction]).zip(on_long_lattice([p, q])) {
        Some((([d], _), ([p, q], _))) => {
            first_sign(|plane| cross_component_sign(minus(q, p), d, plane))
        }
        None => first_sign(|plane| crossed_component(direction, p, q, plane).sign()),
    }
}

/// The sign of the first component that is not zero, of which `sign` tells that in a plane of two axes.
fn first_sign(sign: impl Fn((usize, usize)) -> Ordering) -> Ordering {
    sign((1, 2)).then_with(|| sign((2, 0))).then_with(|| sign((0, 1)))
}

/// (q_j − p_j) d_k − (q_k − p_k) d_j.
fn crossed_component(d: [f64; 3], p: [f64; 3], q: [f64; 3], (j, k): (usize, usize)) -> Accumulator {
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

    const RAY: Ray<3> = Ray {
        origin: [0.0, 0.0, -1.0],
        direction: [0.0, 0.0, 1.0],
        interval: crate::Interval::FORWARD,
    };

    #[test]
    fn an_edge_that_the_ray_meets_has_edge_function_zero() {
        let (p, q) = ([-1.0, 0.0, 5.0], [1e17, 0.0, 3.0]);
        assert_eq!(edge_function(&RAY, p, q).sign(), Ordering::Equal);
        let q = [1e17, f64::from_bits(1), 3.0];
        assert_eq!(edge_function(&RAY, p, q).sign(), Ordering::Greater);
        assert_eq!(edge_function(&RAY, q, p).sign(), Ordering::Less);
    }

    #[test]
    fn the_moved_ray_is_on_opposite_sides_of_an_edge_seen_both_ways() {
        let equal = Ordering::Equal;
        let ahead = [([-1.0, 0.0, 5.0], [2.0, 0.0, 3.0]), ([0.0, 1.0, 2.0], [0.0, -3.0, 4.0])];
        let from_origin = (RAY.origin, [1.0, 2.0, 3.0]);
        for (p, q) in ahead.into_iter().chain([from_origin]) {
            let sign = moved_edge_sign(&RAY, p, q, equal);
            assert_ne!(sign, equal);
            assert_eq!(moved_edge_sign(&RAY, q, p, equal), sign.reverse());
        }
        for x in [0.0, 1.0] {
            let (p, q) = ([x, 0.0, 1.0], [x, 0.0, 4.0]);
            assert_eq!(moved_edge_sign(&RAY, p, q, equal), equal);
        }
    }

    #[test]
    fn moving_is_adding_a_little_to_the_origin() {
        let (equal, little) = (Ordering::Equal, 2.0_f64.powi(-20));
        let (p, q) = ([-1.0, -2.0, 5.0], [2.0, 4.0, 3.0]);
        let s = [little, little * little, 0.0];
        let moved = Ray { origin: std::array::from_fn(|k| RAY.origin[k] + s[k]), ..RAY };
        assert_eq!(moved_edge_sign(&RAY, p, q, equal), edge_sign(&moved, p, q));
        let ray = Ray::<2>::new([0.0, 0.0], [-1.0, 2.0]);
        let moved = Ray::<2>::new([little, little * little], ray.direction);
        assert_eq!(side_of_ray(&ray, [-2.0, 4.0]).sign(), equal);
        assert_eq!(moved_side_sign(&ray, equal), side_of_ray(&moved, [-2.0, 4.0]).sign());
    }

    proptest::proptest! {
        /// Numbers of few digits, whose signs are often zero, of all digits, and of sizes that have no lattice.
        #[test]
        fn the_sign_is_that_of_the_sum(
            numbers in proptest::array::uniform12(-9_i32..10),
            shifts in proptest::array::uniform12(0_i32..58),
            is_shifted in proptest::bool::ANY,
            scales in proptest::array::uniform2(-600_i32..600),
            is_divided in proptest::bool::ANY,
            more in proptest::option::of(0_usize..12),
        ) {
            let shift = |i: usize| if is_shifted { 2.0_f64.powi(shifts[i]) } else { 1.0 };
            let divisor = if is_divided { 3.0 } else { 1.0 };
            let number = |i: usize| f64::from(numbers[i]) * shift(i) / divisor;
            let mut all: [f64; 12] = std::array::from_fn(number);
            all[..3].iter_mut().for_each(|x| *x *= 2.0_f64.powi(scales[0]));
            all[3..].iter_mut().for_each(|x| *x *= 2.0_f64.powi(scales[1]));
            if let Some(place) = more {
                all[place] += 2.0_f64.powi(-600);
            }
            let [d, o, p, q] = [0, 3, 6, 9].map(|i| [all[i], all[i + 1], all[i + 2]]);
            let ray = Ray::new(o, d);
            let sign = edge_function(&ray, p, q).sign();
            proptest::prop_assert_eq!(edge_sign(&ray, p, q), sign);
            if let Some(short) = short_edge_function(&ray, p, q) {
                proptest::prop_assert_eq!(short.value(), edge_function(&ray, p, q).value());
            }
            let corners = [p, q, [q[1], p[0], o[2]]];
            if let Some(short) = short_volume(o, corners) {
                proptest::prop_assert_eq!(short.value(), volume(o, corners).value());
            }
            let component = |plane| crossed_component(d, p, q, plane).sign();
            let moved = component((1, 2)).then(component((2, 0))).then(component((0, 1)));
            proptest::prop_assert_eq!(moved_edge_sign(&ray, p, q, Ordering::Equal), moved);
            proptest::prop_assert_eq!(sign_along(d, p, q), moved);
            for plane in [(0, 1), (2, 0)] {
                let sign = cross_component(o, p, q, plane).sign();
                proptest::prop_assert_eq!(cross_sign(o, p, q, plane), sign);
            }
        }
    }

    #[test]
    fn the_volume_is_zero_for_an_origin_in_the_plane() {
        let triangle = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert_eq!(volume([0.25, 0.25, 0.5], triangle).sign(), Ordering::Equal);
        assert_eq!(volume([0.0; 3], triangle).sign(), Ordering::Less);
        assert_eq!(volume([1.0; 3], triangle).sign(), Ordering::Greater);
    }
}
