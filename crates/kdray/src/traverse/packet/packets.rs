//! Rays in packets: from a slice of rays to their hits.

use super::PacketKind;
use super::bound::Bound;
use super::cull::Cull;
use super::frustum::Frustum;
use super::interval::RayInterval;
use super::masked::MaskedRay;
use super::rays::{PacketRay, Query};
use super::trace::PacketTrace;
use super::walk::PacketWalk;
use crate::geometry::Ray;
use crate::primitives::Hit;
use crate::traverse::{Counters, any_hit, closest_hit};
use crate::tree::KdTree;

/// Primitives and a tree over them, for rays in packets.
///
/// ```
/// use kdray::primitives::Balls;
/// use kdray::traverse::{PacketCounters, PacketKind};
/// use kdray::{BuildOptions, Ray, ShapeScene, Strategy};
/// let balls = Balls::new(vec![([0.0, 0.0, 5.0], 1.0)])?;
/// let scene = ShapeScene::build(balls, &BuildOptions::for_strategy(Strategy::Sah))?;
/// let rays: Vec<Ray> = (0..64).map(|i| Ray::new([0.0; 3], [f64::from(i) / 64.0, 0.0, 1.0])).collect();
/// let mut counters = PacketCounters::default();
/// let hits = scene.packets(PacketKind::Frustum).closest_hits(&rays, &mut counters);
/// assert_eq!(hits[0], scene.closest_hit(&rays[0]));
/// assert_eq!((counters.packets, counters.set_ups, counters.left), (1, 1, 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Packets<'a, P> {
    tree: &'a KdTree<3>,
    primitives: &'a P,
    kind: PacketKind,
    size: usize,
}

impl<'a, P: Cull> Packets<'a, P> {
    /// Packets of the largest size of their kind.
    pub fn new(tree: &'a KdTree<3>, primitives: &'a P, kind: PacketKind) -> Self {
        Self { tree, primitives, kind, size: kind.largest() }
    }

    /// The same with packets of `size` rays: at least one, and no more than the kind's largest.
    #[must_use]
    pub fn with_size(self, size: usize) -> Self {
        Self { size: size.clamp(1, self.kind.largest()), ..self }
    }

    /// The closest hit of each ray, the same as the single traversal's to the last bit.
    ///
    /// Rays that follow each other are taken together, so they should be neighbours. A packet bounds
    /// those that fit its first ray that meets the tree's box; others are answered one by one.
    pub fn closest_hits(&self, rays: &[Ray<3>], trace: &mut impl PacketTrace) -> Vec<Option<Hit>> {
        self.hits(rays, Query::Closest, trace)
    }

    /// Whether each ray hits anything, taken together in the same way. Rays that end at one point,
    /// such as shadow rays with t up to one at a light, are bounded by a frustum with its apex there.
    pub fn any_hits(&self, rays: &[Ray<3>], trace: &mut impl PacketTrace) -> Vec<bool> {
        self.hits(rays, Query::Any, trace).iter().map(Option::is_some).collect()
    }

    fn hits(
        &self,
        rays: &[Ray<3>],
        query: Query,
        trace: &mut impl PacketTrace,
    ) -> Vec<Option<Hit>> {
        let mut hits = vec![None; rays.len()];
        let alive = |(index, ray)| PacketRay::new(index, ray, &self.tree.bounds);
        let mut alive: Vec<PacketRay> = rays.iter().enumerate().filter_map(alive).collect();
        for rays in alive.chunk_by_mut(|a, b| a.index / self.size == b.index / self.size) {
            match self.kind {
                PacketKind::Masked => self.run::<MaskedRay>(rays, query, trace),
                PacketKind::Interval => self.run::<RayInterval>(rays, query, trace),
                PacketKind::Frustum => self.run::<Frustum>(rays, query, trace),
            }
        }
        for ray in alive {
            hits[ray.index] = ray.hit();
        }
        hits
    }

    /// Answers the rays of one packet.
    fn run<B: Bound>(&self, rays: &mut [PacketRay], query: Query, trace: &mut impl PacketTrace) {
        let Some(shared) = B::shared(rays) else { return };
        rays.sort_by_key(|ray| !B::fits(&shared, ray));
        let fit = rays.partition_point(|ray| B::fits(&shared, ray));
        let (together, left) = rays.split_at_mut(fit);
        if !together.is_empty() {
            let world = (self.tree, self.primitives);
            PacketWalk::<B, P>::new(world, together, &shared, self.size, query, trace).run(trace);
        }
        for ray in left {
            let mut cost = Counters::default();
            let search = if query == Query::Any { any_hit } else { closest_hit };
            ray.answer(search(self.tree, self.primitives, ray.ray(), &mut cost));
            trace.left(ray.index, &cost);
        }
    }
}
