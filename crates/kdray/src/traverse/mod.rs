//! From a ray to the leaves it passes, in order, and to its hits.
//!
//! [`LeafWalk`] is the one traversal (S11): closest, any and all hits differ only in what they do
//! with the leaves that it yields. The walk is *conservative*: intervals are closed and widened by
//! 2^-38 of t, so that neither the rounding of a plane's t nor that of a hit's t (2^-39 at most,
//! see [`crate::primitives::intersect_triangle`]) keeps it from a leaf whose cell holds a hit.

mod all_hits;
mod cell_walk;
mod closest;
mod closest_point;
mod leaf_walk;
mod naive;
mod packet;
mod trace;
mod vicinity;
mod visible;
pub(crate) mod wide;
mod winding;

pub use all_hits::AllHits;
pub use cell_walk::CellWalk;
pub use closest::{any_hit, closest_hit};
pub use closest_point::closest_point;
pub use leaf_walk::{LeafVisit, LeafWalk};
pub use naive::Naive;
pub use packet::{
    Cull, Frustum, LaneMask, PacketCounters, PacketDecision, PacketKind, PacketLeafStep,
    PacketRecorder, PacketSplitStep, PacketStep, PacketTrace, Packets,
};
pub use trace::{Counters, LeafStep, SplitStep, Step, StepRecorder, Trace, TraversalCase};
pub use visible::is_visible;
pub use winding::winding_number;
