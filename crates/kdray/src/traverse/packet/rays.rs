//! The rays of a packet, and what they have found.

use super::super::closest::ClosestSoFar;
use crate::geometry::{Aabb, Interval, Ray};
use crate::primitives::{Hit, Intersect};

/// What is asked of every ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Query {
    /// The hit of least t.
    Closest,
    /// Whether there is any.
    Any,
}

/// A ray that meets the tree's box.
#[derive(Clone, Debug)]
pub(super) struct PacketRay {
    /// Its place among the rays of the packet.
    pub(super) index: usize,
    /// The t at which it may be in the tree's box.
    pub(super) inside: Interval,
    nearest: ClosestSoFar<3>,
    is_done: bool,
}

impl PacketRay {
    /// None for a dead ray: one that cannot be traced or misses the box. Dead rays hit nothing, and
    /// must not widen the bounds of the others.
    pub(super) fn new(index: usize, ray: &Ray<3>, bounds: &Aabb<3>) -> Option<Self> {
        ray.check().ok()?;
        let inside = bounds.slab(ray)?;
        Some(Self { index, inside, nearest: ClosestSoFar::new(ray), is_done: false })
    }

    /// The ray, up to the nearest hit so far.
    pub(super) fn ray(&self) -> &Ray<3> {
        &self.nearest.ray
    }

    /// What was found so far.
    pub(super) fn hit(&self) -> Option<Hit> {
        self.nearest.hit
    }

    /// Whether nothing is left to find.
    pub(super) fn is_done(&self) -> bool {
        self.is_done
    }

    /// Takes an answer that was found otherwise.
    pub(super) fn answer(&mut self, hit: Option<Hit>) {
        self.nearest.hit = hit;
    }

    /// Tests one primitive; the t of its hit, if any.
    pub(super) fn test(
        &mut self,
        primitives: &impl Intersect<3>,
        id: u32,
        query: Query,
    ) -> Option<f64> {
        let t = self.nearest.test(primitives, id);
        self.is_done = query == Query::Any && self.nearest.hit.is_some();
        t
    }
}
