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
    let mut best: Option<Hit> = None;
    let mut walk = LeafWalk::new(tree, ray, trace);
    let mut open = *ray;
    while let Some(leaf) = walk.next_leaf(open.interval.t_max, trace) {
        for &id in leaf.primitives {
            let mut t = None;
            primitives.intersect(id, &open, HitRule::Touching, &mut |hit| {
                if t.is_none_or(|t| hit.t < t) {
                    t = Some(hit.t);
                }
                if best.is_none_or(|best| hit.precedes(&best)) {
                    best = Some(hit);
                }
            });
            trace.primitive(id, t);
            // Hits at the same t still count: a smaller id wins.
            open.interval.t_max = best.map_or(open.interval.t_max, |best| best.t);
        }
    }
    best
}

/// Some hit on `ray`, not necessarily the first, but the same one on every run.
#[inline]
pub fn any_hit<const K: usize>(
    tree: &KdTree<K>,
    primitives: &impl Intersect<K>,
    ray: &Ray<K>,
    trace: &mut impl Trace,
) -> Option<Hit> {
    let mut walk = LeafWalk::new(tree, ray, trace);
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
