//! What bounds the rays of a lane, so that one question about a node answers for all of them.

use super::cull::Cull;
use super::rays::PacketRay;
use crate::geometry::{Interval, Ray};

/// A bound of some rays that have something in common.
///
/// It has a t of its own for all of them. Every answer is conservative: where an exact hit lies, the
/// bound's interval is not empty and holds the hit's t.
pub(super) trait Bound: Sized {
    /// What all rays of a packet share.
    type Shared;

    /// Whether a primitive is tested once for each lane, and not again in the next leaf.
    const HAS_MAILBOX: bool;

    /// How many rays a lane holds, of a packet of `size`.
    fn lane_size(size: usize) -> usize;

    /// What rays must share to travel with those given, of which there is at least one.
    fn shared(rays: &[PacketRay]) -> Option<Self::Shared>;

    /// Whether a ray shares it.
    fn fits(shared: &Self::Shared, ray: &PacketRay) -> bool;

    /// The bound of rays that fit, of which there is at least one.
    fn around(shared: &Self::Shared, rays: &[PacketRay]) -> Self;

    /// Where the rays are in the tree's box.
    fn inside_root(&self, rays: &[PacketRay]) -> Interval;

    /// Up to which of the bound's t a ray is open.
    fn reach(&self, ray: &Ray<3>) -> f64;

    /// Whether the child below the plane comes first.
    fn lower_is_near(&self, axis: usize, split: f64) -> bool;

    /// The parts of `inside`, which is not empty, in which rays may be in the near child and in the
    /// far one.
    fn children(&self, axis: usize, split: f64, inside: Interval) -> [Interval; 2];

    /// Whether no ray can hit the primitive. Only frusta can tell.
    fn misses(&self, _primitives: &impl Cull, _id: u32) -> bool {
        false
    }

    /// The frustum, if the bound is one.
    fn as_frustum(&self) -> Option<&super::Frustum> {
        None
    }
}
