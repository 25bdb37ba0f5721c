//! Strategy D (S10): the plane of least cost.
//!
//! Candidates are the bounds of the primitives' parts in the node's cell ("perfect splits",
//! Havran 2000, §4.3), as far as they lie strictly inside: between two neighbouring ones the cost
//! is linear. The sweep and the naive builder share everything but how they count.

mod binned;
mod candidate;
mod event;
mod naive;
mod sweep;

pub(super) use binned::Binned;
pub(super) use naive::Naive;
pub(super) use sweep::Sweep;
