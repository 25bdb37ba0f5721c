//! Signs and values that floating point cannot be trusted with.
//!
//! A hit is decided as if in real arithmetic on the given floats. Plain f64 with an error bound
//! settles nearly all cases (the *filter*, in [`crate::primitives`]); what is left is evaluated
//! here without any rounding: in integers of 60 or 118 bits where the numbers are multiples of one unit,
//! else in an [`Accumulator`] wide enough for every sum of products of three f64 numbers.
//!
//! # The edge function
//! With p' = p − o relative to the ray's origin, the edge function of the directed edge (p, q) is
//! `d · (q' x p')`. The line of the ray passes a triangle (a, b, c) where the edge functions W of
//! (b, c), U of (c, a) and V of (a, b) have one sign; U + V + W = den, u = U / den, v = V / den,
//! and t = T / den with T = −a' · (b' x c').
//!
//! # The moved ray
//! Crossings are counted for the ray as moved aside by an infinitesimal s = (ε, ε², ε³). Its edge functions
//! differ by s · ((q − p) x d), so if one is zero its sign is that of the first component of (q − p) x d that
//! is not. All triangles see the same moved ray, so neighbours agree on their common edge, and each crossing
//! of a closed surface counts once, wherever on its line the ray begins: at a vertex, too. Only an edge parallel
//! to the ray is neither left nor right of it; where its edge function is zero the ray runs in the plane of its
//! triangles, and they are not crossed, for the moved ray is parallel to them. This is Edelsbrunner and Mücke's simulation of simplicity (1990), applied to the ray.

mod accumulator;
mod area;
mod edge;
mod edge_signs;
mod hit_values;
mod lattice;
mod on_triangle;
mod plane_side;
mod segment;

pub(crate) use accumulator::not_vanished;
pub use accumulator::{Accumulator, Scaled};
pub use area::has_area;
pub use edge::{
    cross_component, directed_edges, edge_function, moved_side_sign, side_of_ray, volume,
};
pub use edge_signs::EdgeSigns;
pub use hit_values::{Values, hit_t, hit_values};
pub use on_triangle::is_on_triangle;
pub use plane_side::side_of_plane;
pub use segment::segment_crosses;
