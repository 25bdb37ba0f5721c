//! Packets of rays on the canonical tree (S12), to be watched: for lectures, pictures and comparison.
//!
//! Rays that are neighbours meet nearly the same nodes. A packet asks each node once for all of its
//! rays: a *bound* around them is considered first. [`PacketKind`] says which bound: that of each ray
//! in a lane of its own, one interval of t, or a *frustum* with eight sub-frusta. All three share the
//! traversal of `walk.rs`, which is that of [`LeafWalk`](super::LeafWalk) with up to eight *lanes* in
//! place of one ray: a lane is a group of rays under one bound.
//!
//! What is exact: leaves are tested by the same `intersect` as everywhere, and bounds are
//! conservative, with the slack of `geometry/slack.rs`. So every ray gets the hit that the single
//! traversal gives, to the last bit. Rays that have nothing in common with their packet are *left*:
//! the single traversal answers them.
//!
//! The fast packets are others; these are scalar, and as plain as they can be.

mod bound;
mod bundle;
mod cull;
mod frustum;
mod interval;
mod kind;
mod lanes;
mod mailbox;
mod masked;
mod packets;
mod rays;
mod recorder;
mod signs;
mod trace;
mod walk;

pub use cull::Cull;
pub use frustum::Frustum;
pub use kind::PacketKind;
pub use lanes::LaneMask;
pub use packets::Packets;
pub use recorder::{PacketRecorder, PacketStep};
pub use trace::{PacketCounters, PacketDecision, PacketLeafStep, PacketSplitStep, PacketTrace};

use lanes::LANES;
