//! Where a line meets a triangle that it surely meets.

use super::Scaled;
use super::accumulator::Accumulator;
use super::edge::{directed_edges, edge_function, short_volume, volume};
use super::lattice::{minus, on_long_lattice, triple_product};
use crate::geometry::Ray;
use std::cmp::Ordering;

/// t, u, v and whether the front is hit.
pub type Values = (f64, f64, f64, bool);

/// t, u, v and whether the front is hit, without rounding before the final quotients.
pub fn hit_values(ray: &Ray<3>, corners: [[f64; 3]; 3]) -> Values {
    in_short(ray, corners).unwrap_or_else(|| {
        let edges = directed_edges(corners).map(|(p, q)| edge_function(ray, p, q));
        quotients(edges, volume(ray.origin, corners).value())
    })
}

/// t from a den that is good.
pub fn hit_t(ray: &Ray<3>, corners: [[f64; 3]; 3], den: f64) -> f64 {
    let short = short_volume(ray.origin, corners).map(|volume| volume.value());
    let volume = short.unwrap_or_else(|| volume(ray.origin, corners).value());
    volume.divided_by(Scaled::from(den))
}

/// The same, unless sizes are too different or out of the ordinary.
fn in_short(ray: &Ray<3>, corners: [[f64; 3]; 3]) -> Option<Values> {
    let [a, b, c] = corners;
    let ([d], direction_unit) = on_long_lattice([ray.direction])?;
    let ([o, a, b, c], unit) = on_long_lattice([ray.origin, a, b, c])?;
    let corners = [a, b, c].map(|p| minus(p, o));
    let [a, b, c] = corners;
    let edge = |(p, q)| triple_product(d, q, p, direction_unit + 2 * unit);
    let volume = triple_product(a, c, b, 3 * unit);
    Some(quotients(directed_edges(corners).map(edge), volume.value()))
}

fn quotients<const LIMBS: usize>([w, u, v]: [Accumulator<LIMBS>; 3], t: Scaled) -> Values {
    let mut den = w;
    den.add_all(&u);
    den.add_all(&v);
    let front = den.sign() == Ordering::Greater;
    let den = den.value();
    (t.divided_by(den), u.value().divided_by(den), v.value().divided_by(den), front)
}
