//! Packets on the wide tree: many rays that share an origin, a direction or a target, bounded by a
//! frustum that is considered first (S12).
//!
//! ```text
//! prepare     64 or 512 rays become points of a plane (projection: perspective or parallel)
//! frustum     bounds them, and is tested against the eight boxes of a node at once
//! forms       eight triangles become lines of that plane; the bounding frustum culls them,
//! search      then the sub-frusta of the packet's sets and vectors do; what is left meets eight rays
//!             at a time, of which the filter leaves few to the scalar test
//! finish      the numbers of the hits, as the scalar test gives them
//! pace        how large the next packet is, or whether rays go alone
//! ```
//!
//! All in f32 is a filter, as in the other kernels: its error bounds say which triangles are surely
//! hit, surely missed, and surely nearer. The packets of [`crate::traverse::packet`] are made to be watched; these
//! are made to be fast.

mod finish;
mod forms;
mod frustum;
mod kernel;
mod pace;
mod parallel;
mod perspective;
mod prepare;
mod projection;
mod rays;
mod scratch;
mod search;

pub(crate) use kernel::{Answers, Packets};
pub use pace::PacketWork;
pub(crate) use scratch::Scratch;
