//! Where a line meets a triangle that it surely meets.

use super::Scaled;
use super::accumulator::Accumulator;
use super::edge::{directed_edges, edge_function, short_volume, volume};
use super::edge_signs::Integers;
use super::lattice::triple_product;
use crate::geometry::Ray;
use std::cmp::Ordering;

/// t, u, v and whether the front is hit.
pub type Values = (f64, f64, f64, bool);

/// t, u, v and whether the front is hit, from T, U, V and den that are rounded once each.
pub fn hit_values(ray: &Ray<3>, corners: [[f64; 3]; 3]) -> Values {
    in_short(ray, corners).unwrap_or_else(|| {
        let edges = directed_edges(corners).map(|(p, q)| edge_function(ray, p, q));
        quotients(edges, volume(ray.origin, corners).value())
    })
}

/// [`hit_values`], unless sizes are too different or out of the ordinary.
fn in_short(ray: &Ray<3>, corners: [[f64; 3]; 3]) -> Option<Values> {
    let (Integers { direction, corners }, [direction_unit, unit]) = Integers::long(ray, corners)?;
    let [a, b, c] = corners;
    let edge = |(p, q)| triple_product(direction, q, p, direction_unit + 2 * unit);
    let volume = triple_product(a, c, b, 3 * unit);
    Some(quotients(directed_edges(corners).map(edge), volume.value()))
}

/// t, where den is good by the filter and T is not.
pub fn hit_t(ray: &Ray<3>, corners: [[f64; 3]; 3], den: f64) -> f64 {
    let short = short_volume(ray.origin, corners).map(|volume| volume.value());
    let volume = short.unwrap_or_else(|| volume(ray.origin, corners).value());
    volume.divided_by(Scaled::from(den))
}

fn quotients<const LIMBS: usize>([w, u, v]: [Accumulator<LIMBS>; 3], t: Scaled) -> Values {
    let mut den = w;
    den.add_all(&u);
    den.add_all(&v);
    let front = den.sign() == Ordering::Greater;
    let den = den.value();
    (t.divided_by(den), u.value().divided_by(den), v.value().divided_by(den), front)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn short_sums_give_the_bits_of_long_ones(
            corners in prop::array::uniform3(prop::array::uniform3(-1.0..1.0)),
            origin in prop::array::uniform3(-9.0..9.0),
            direction in prop::array::uniform3(-1.0..1.0),
            size in -900_i32..900,
        ) {
            let scale = 2.0_f64.powi(size);
            let corners = corners.map(|p: [f64; 3]| p.map(|x| x * scale));
            let ray = Ray::new(origin.map(|x: f64| x * scale), direction);
            let edges = directed_edges(corners).map(|(p, q)| edge_function(&ray, p, q));
            let long = volume(ray.origin, corners).value();
            if let Some(short) = in_short(&ray, corners) {
                prop_assert_eq!(short, quotients(edges, long));
                prop_assert_eq!(hit_t(&ray, corners, 0.7), long.divided_by(Scaled::from(0.7)));
            }
        }
    }

    #[test]
    fn numbers_of_all_digits_are_short() {
        let corners = [[0.1, 0.2, 3.3], [1.1, 0.3, 3.1], [0.2, 1.7, 2.9]];
        assert!(in_short(&Ray::new([0.3, 0.4, 0.5], [0.01, 0.02, 1.0]), corners).is_some());
    }
}
