//! The signs of a triangle's edge functions.

use super::edge::{crossed_component, directed_edges, edge_function};
use super::lattice::{
    cross_component_sign, minus, on_lattice, on_long_lattice, sign_of_products, times,
    triple_product,
};
use crate::geometry::Ray;
use std::cell::OnceCell;
use std::cmp::Ordering;

/// On which sides of a triangle's edges the line of a ray passes. What the edges share is made once: the ray and
/// the corners as integers, if they have few enough digits.
pub struct EdgeSigns<'a> {
    ray: &'a Ray<3>,
    corners: [[f64; 3]; 3],
    short: Option<Integers<i64>>,
    long: OnceCell<Option<Integers<i128>>>,
}

/// A direction, and corners relative to the origin. Each may be times a positive number.
pub(super) struct Integers<I> {
    pub(super) direction: [I; 3],
    pub(super) corners: [[I; 3]; 3],
}

impl<'a> EdgeSigns<'a> {
    /// Of finite corners.
    pub fn new(ray: &'a Ray<3>, corners: [[f64; 3]; 3]) -> Self {
        let short = Integers::short(ray, corners);
        Self { ray, corners, short, long: OnceCell::new() }
    }

    /// The sign of the [`edge_function`] of edge `i`, as [`directed_edges`] numbers them.
    pub fn sign(&self, i: usize) -> Ordering {
        let (p, q) = directed_edges([0, 1, 2])[i];
        if let Some(Integers { direction: d, corners }) = &self.short {
            let (p, q) = (corners[p], corners[q]);
            let minor = |i: usize, j: usize| times(q[i], p[j]) - times(q[j], p[i]);
            let pairs = [(d[0], minor(1, 2)), (d[1], minor(2, 0)), (d[2], minor(0, 1))];
            return sign_of_products(pairs);
        }
        match self.long() {
            Some(Integers { direction, corners }) => {
                triple_product(*direction, corners[q], corners[p], 0).sign()
            }
            None => edge_function(self.ray, self.corners[p], self.corners[q]).sign(),
        }
    }

    /// The same for the moved ray (see [`crate::exact`]); `Equal` only if the edge is parallel to the ray, or has no
    /// length. `sign` is that for the ray as it is.
    pub fn moved_sign(&self, i: usize, sign: Ordering) -> Ordering {
        if sign != Ordering::Equal {
            return sign;
        }
        let (p, q) = directed_edges([0, 1, 2])[i];
        if let Some(Integers { direction: d, corners }) = &self.short {
            let along = |k: usize| corners[q][k] - corners[p][k];
            return first_sign(|(j, k)| times(along(j), d[k]).cmp(&times(along(k), d[j])));
        }
        match self.long() {
            Some(Integers { direction, corners }) => {
                let along = minus(corners[q], corners[p]);
                first_sign(|plane| cross_component_sign(along, *direction, plane))
            }
            None => {
                let (p, q) = (self.corners[p], self.corners[q]);
                first_sign(|plane| crossed_component(self.ray.direction, p, q, plane).sign())
            }
        }
    }

    fn long(&self) -> Option<&Integers<i128>> {
        self.long.get_or_init(|| Some(Integers::long(self.ray, self.corners)?.0)).as_ref()
    }
}

impl Integers<i64> {
    /// The direction below 2^60, the corners below 2^61.
    fn short(ray: &Ray<3>, [a, b, c]: [[f64; 3]; 3]) -> Option<Self> {
        let o = ray.origin;
        let direction = on_lattice(ray.direction)?;
        let all = [o[0], o[1], o[2], a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]];
        let all = on_lattice(all)?;
        let from_origin = |first: usize| [0, 1, 2].map(|k| all[first + k] - all[k]);
        Some(Self { direction, corners: [3, 6, 9].map(from_origin) })
    }
}

impl Integers<i128> {
    /// The direction below 2^118 and the corners below 2^119, with the powers of two of their units; `None` if sizes are
    /// too different.
    pub(super) fn long(ray: &Ray<3>, [a, b, c]: [[f64; 3]; 3]) -> Option<(Self, [i32; 2])> {
        let ([direction], direction_unit) = on_long_lattice([ray.direction])?;
        let ([o, a, b, c], unit) = on_long_lattice([ray.origin, a, b, c])?;
        let corners = [a, b, c].map(|p| minus(p, o));
        Some((Self { direction, corners }, [direction_unit, unit]))
    }
}

/// The sign of the first component that is not zero, of which `sign` tells that in a plane of two axes.
fn first_sign(sign: impl Fn((usize, usize)) -> Ordering) -> Ordering {
    sign((1, 2)).then_with(|| sign((2, 0))).then_with(|| sign((0, 1)))
}

#[cfg(test)]
mod tests {
    use super::super::edge::{cross_sign, moved_side_sign, short_volume, side_of_ray};
    use super::super::{cross_component, volume};
    use super::*;

    const RAY: Ray<3> = Ray {
        origin: [0.0, 0.0, -1.0],
        direction: [0.0, 0.0, 1.0],
        interval: crate::Interval::FORWARD,
    };

    fn edge_sign(ray: &Ray<3>, p: [f64; 3], q: [f64; 3]) -> Ordering {
        EdgeSigns::new(ray, [p, q, q]).sign(2)
    }

    fn moved_edge_sign(ray: &Ray<3>, p: [f64; 3], q: [f64; 3]) -> Ordering {
        EdgeSigns::new(ray, [p, q, q]).moved_sign(2, Ordering::Equal)
    }

    #[test]
    fn the_moved_ray_is_on_opposite_sides_of_an_edge_seen_both_ways() {
        let equal = Ordering::Equal;
        let ahead = [([-1.0, 0.0, 5.0], [2.0, 0.0, 3.0]), ([0.0, 1.0, 2.0], [0.0, -3.0, 4.0])];
        let from_origin = (RAY.origin, [1.0, 2.0, 3.0]);
        for (p, q) in ahead.into_iter().chain([from_origin]) {
            let sign = moved_edge_sign(&RAY, p, q);
            assert_ne!(sign, equal);
            assert_eq!(moved_edge_sign(&RAY, q, p), sign.reverse());
        }
        for x in [0.0, 1.0] {
            let (p, q) = ([x, 0.0, 1.0], [x, 0.0, 4.0]);
            assert_eq!(moved_edge_sign(&RAY, p, q), equal);
        }
    }

    #[test]
    fn moving_is_adding_a_little_to_the_origin() {
        let (equal, little) = (Ordering::Equal, 2.0_f64.powi(-20));
        let (p, q) = ([-1.0, -2.0, 5.0], [2.0, 4.0, 3.0]);
        let s = [little, little * little, 0.0];
        let moved = Ray { origin: std::array::from_fn(|k| RAY.origin[k] + s[k]), ..RAY };
        assert_eq!(moved_edge_sign(&RAY, p, q), edge_sign(&moved, p, q));
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
            let component = |plane| crossed_component(d, p, q, plane).sign();
            let moved = component((1, 2)).then(component((2, 0))).then(component((0, 1)));
            // Edge 2 of the first, 0 of the second, and 1 of the third.
            for (i, corners) in [(2, [p, q, q]), (0, [o, p, q]), (1, [q, d, p])] {
                let usual = EdgeSigns::new(&ray, corners);
                let long = EdgeSigns { short: None, ..EdgeSigns::new(&ray, corners) };
                let long_too = OnceCell::from(None);
                let longest = EdgeSigns { ray: &ray, corners, short: None, long: long_too };
                for signs in [usual, long, longest] {
                    proptest::prop_assert_eq!(signs.sign(i), sign);
                    proptest::prop_assert_eq!(signs.moved_sign(i, Ordering::Equal), moved);
                }
            }
            let corners = [p, q, [q[1], p[0], o[2]]];
            if let Some(short) = short_volume(o, corners) {
                proptest::prop_assert_eq!(short.value(), volume(o, corners).value());
            }
            for plane in [(0, 1), (2, 0)] {
                let sign = cross_component(o, p, q, plane).sign();
                proptest::prop_assert_eq!(cross_sign(o, p, q, plane), sign);
            }
        }
    }
}
