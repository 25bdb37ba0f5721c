//! All hits, in order, as they are asked for.

use super::{LeafWalk, Trace};
use crate::geometry::{Interval, Ray};
use crate::primitives::{Hit, HitRule, Intersect};
use crate::tree::KdTree;
use std::iter::FusedIterator;

/// The hits of a ray by rising t, equal t by rising primitive id, each once.
///
/// Lazy: leaves are visited only as far as the next hit needs. A hit found in a leaf is yielded as
/// soon as no later leaf can hold an earlier one; till then it is `pending`. So who wants a few stops
/// asking, or says [`take`](Iterator::take), and pays for no more; [`after`](Self::after) goes on
/// later.
#[derive(Debug)]
#[must_use = "hits are found only as they are asked for"]
pub struct AllHits<'a, P, const K: usize, T = ()> {
    primitives: &'a P,
    ray: Ray<K>,
    rule: HitRule,
    walk: LeafWalk<'a, K>,
    trace: T,
    /// Found, not yielded; the next one last.
    pending: Vec<Hit>,
    last: Option<Hit>,
}

/// Not derived, which would ask for primitives that can be cloned.
impl<P, const K: usize, T: Clone> Clone for AllHits<'_, P, K, T> {
    fn clone(&self) -> Self {
        let (walk, trace, pending) = (self.walk.clone(), self.trace.clone(), self.pending.clone());
        Self { walk, trace, pending, ..*self }
    }
}

impl<'a, P: Intersect<K>, const K: usize, T: Trace> AllHits<'a, P, K, T> {
    /// The hits of `ray` that count by `rule`.
    pub fn new(
        tree: &'a KdTree<K>,
        primitives: &'a P,
        ray: &Ray<K>,
        rule: HitRule,
        mut trace: T,
    ) -> Self {
        let walk = LeafWalk::over(tree, primitives, ray, &mut trace);
        Self { primitives, ray: *ray, rule, walk, trace, pending: Vec::new(), last: None }
    }

    /// The hits of `ray` that come after `last`, one of them: as if all up to it were taken from
    /// [`new`](Self::new). Others at the same t are neither lost nor repeated.
    pub fn after(
        tree: &'a KdTree<K>,
        primitives: &'a P,
        ray: &Ray<K>,
        rule: HitRule,
        last: &Hit,
        trace: T,
    ) -> Self {
        let Interval { t_min, t_max } = ray.interval;
        // A NaN stays one, and hits nothing.
        let t_min = if last.t > t_min { last.t } else { t_min };
        let rest = ray.with_interval(t_min, t_max);
        Self { last: Some(*last), ..Self::new(tree, primitives, &rest, rule, trace) }
    }

    /// Adds the hits of the next leaf to the pending ones; false if there is no such leaf.
    fn visit_leaf(&mut self) -> bool {
        let t_max = self.ray.interval.t_max;
        let Some(leaf) = self.walk.next_leaf(t_max, &mut self.trace) else { return false };
        let Self { primitives, ray, rule, trace, pending, last, .. } = self;
        let before = pending.len();
        for &id in leaf.primitives {
            let mut t = None;
            primitives.intersect(id, ray, *rule, &mut |hit| {
                t = t.or(Some(hit.t));
                if last.is_none_or(|last| last.order(&hit).is_lt()) {
                    pending.push(hit);
                }
            });
            trace.primitive(id, t);
        }
        if pending.len() > before {
            pending.sort_by(|a, b| b.order(a));
            // A primitive listed by several leaves is found again in each.
            pending.dedup();
        }
        true
    }
}

impl<P: Intersect<K>, const K: usize, T: Trace> FusedIterator for AllHits<'_, P, K, T> {}

impl<P: Intersect<K>, const K: usize, T: Trace> Iterator for AllHits<'_, P, K, T> {
    type Item = Hit;

    fn next(&mut self) -> Option<Hit> {
        while self.pending.last().is_none_or(|next| next.t >= self.walk.t_next()) {
            if !self.visit_leaf() {
                break;
            }
        }
        let next = self.pending.pop()?;
        self.last = Some(next);
        Some(next)
    }
}
