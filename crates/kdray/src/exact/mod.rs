//! Signs and values that floating point cannot be trusted with.
//!
//! A hit is decided as if in real arithmetic on the given floats. Plain f64 with an error bound
//! settles nearly all cases (the *filter*, in [`crate::primitives`]); what is left is evaluated
//! here without any rounding, in an [`Accumulator`] wide enough for every sum of products of three
//! f64 numbers.
//!
//! # The edge function
//! With p' = p − o relative to the ray's origin, the edge function of the directed edge (p, q) is
//! `d · (q' x p')`. The line of the ray passes a triangle (a, b, c) where the edge functions W of
//! (b, c), U of (c, a) and V of (a, b) have one sign; U + V + W = den, u = U / den, v = V / den,
//! and t = T / den with T = −a' · (b' x c').
//!
//! # The turned ray
//! Crossings are counted for the ray as turned by an infinitesimal (ε, ε²) in its two slopes: with
//! k the axis of largest |d| and (u, v) the two behind it in cyclic order, d/d_k becomes
//! d/d_k + ε·e_u + ε²·e_v. An edge function is linear in the slopes, so if it is zero its sign is
//! that of component u of q' x p', and if that is zero, of component v. All triangles see the same
//! turned ray, so neighbours agree on their common edge, and each crossing of a closed surface
//! counts once. If all three are zero the edge points at the ray's origin, and the triangle is not
//! crossed. This is Edelsbrunner and Mücke's simulation of simplicity (1990), applied to the ray.

mod accumulator;
mod edge;
mod lattice;
mod on_triangle;
mod plane_side;
mod segment;

pub(crate) use accumulator::not_vanished;
pub use accumulator::{Accumulator, Scaled};
pub use edge::{
    cross_component, edge_function, edge_sign, side_of_ray, turned_edge_sign, turned_side_sign,
    volume,
};
pub use on_triangle::is_on_triangle;
pub use plane_side::side_of_plane;
pub use segment::segment_crosses;
