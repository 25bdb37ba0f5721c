//! The first hit, and whether there is any.

use super::{LeafWalk, Trace};
use crate::geometry::Ray;
use crate::primitives::{Hit, HitRule, Intersect};
use crate::tree::KdTree;

/// The hit of least t on `ray`; of several at the same t, the one of the smallest primitive id.
#[inline]
pub fn closest_hit<const K: usize>(
    tree: &KdTree<K>,
    primitives: &impl Intersect<K>,
    ray: &Ray<K>,
    trace: &mut impl Trace,
) -> Option<Hit> {
    let mut walk = LeafWalk::over(tree, primitives, ray, trace);
    let mut nearest = ClosestSoFar::new(ray);
    while let Some(leaf) = walk.next_leaf(nearest.ray.interval.t_max, trace) {
        for &id in leaf.primitives {
            let t = nearest.test(primitives, id);
            trace.primitive(id, t);
        }
    }
    nearest.hit
}

/// A ray on its way to its first hit.
#[derive(Clone, Debug)]
pub(super) struct ClosestSoFar<const K: usize> {
    /// The ray up to what was found.
    pub(super) ray: Ray<K>,
    /// What was found.
    pub(super) hit: Option<Hit>,
}

impl<const K: usize> ClosestSoFar<K> {
    #[inline]
    pub(super) fn new(ray: &Ray<K>) -> Self {
        Self { ray: *ray, hit: None }
    }

    /// Tests one primitive; the least t of its hits, if any.
    #[inline]
    pub(super) fn test(&mut self, primitives: &impl Intersect<K>, id: u32) -> Option<f64> {
        let Self { ray, hit: best } = self;
        let mut t = None;
        primitives.intersect(id, ray, HitRule::Touching, &mut |hit| {
            if t.is_none_or(|t| hit.t < t) {
                t = Some(hit.t);
            }
            if best.is_none_or(|best| hit.precedes(&best)) {
                *best = Some(hit);
            }
        });
        // Hits at the same t still count: a smaller id wins.
        ray.interval.t_max = best.map_or(ray.interval.t_max, |best| best.t);
        t
    }
}

/// Some hit on `ray`, not necessarily the first, but the same one on every run.
#[inline]
pub fn any_hit<const K: usize>(
    tree: &KdTree<K>,
    primitives: &impl Intersect<K>,
    ray: &Ray<K>,
    trace: &mut impl Trace,
) -> Option<Hit> {
    let mut walk = LeafWalk::over(tree, primitives, ray, trace);
    while let Some(leaf) = walk.next_leaf(ray.interval.t_max, trace) {
        for &id in leaf.primitives {
            let mut found = None;
            primitives.intersect(id, ray, HitRule::Touching, &mut |hit| found = Some(hit));
            trace.primitive(id, found.map(|hit| hit.t));
            if found.is_some() {
                return found;
            }
        }
    }
    None
}
