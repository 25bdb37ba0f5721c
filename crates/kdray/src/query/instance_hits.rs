//! All hits on instances, in order, as they are asked for.

use super::asked::Asked;
use super::{InstanceHit, InstancedScene, Precision};
use crate::geometry::Ray;
use crate::primitives::{HitRule, TriangleMesh};
use crate::traverse::{AllHits, LeafWalk};
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::collections::binary_heap::PeekMut;
use std::iter::FusedIterator;

/// The hits of a ray on instances by rising t, equal t by rising instance and primitive id, each once.
///
/// Lazy: instances are asked only when the walk comes to them, and each only for its next hit.
#[derive(Debug)]
#[must_use = "hits are found only as they are asked for"]
pub struct InstanceHits<'a, T: 'static = f32> {
    scene: &'a InstancedScene<T>,
    ray: Ray,
    rule: HitRule,
    walk: LeafWalk<'a, 3>,
    /// Instances that were come to.
    begun: Asked,
    /// Those that have a next hit, the first of which is on top.
    waiting: BinaryHeap<Waiting<'a, T>>,
}

/// An instance with its next hit, and those after it.
#[derive(Debug)]
struct Waiting<'a, T: 'static> {
    next: InstanceHit,
    rest: AllHits<'a, TriangleMesh<T>, 3>,
}

impl<'a, T: Precision> InstanceHits<'a, T> {
    pub(super) fn new(scene: &'a InstancedScene<T>, ray: &Ray, rule: HitRule) -> Self {
        let walk = scene.walk(ray);
        let (begun, waiting) = (Asked::default(), BinaryHeap::new());
        Self { scene, ray: *ray, rule, walk, begun, waiting }
    }

    /// Begins with the instances of the next leaf; false if there is none.
    fn visit_leaf(&mut self) -> bool {
        let Some(leaf) = self.walk.next_leaf(self.ray.interval.t_max, &mut ()) else {
            return false;
        };
        for &id in leaf.primitives {
            if self.begun.is_new(id)
                && let Some((geometry, carried)) = self.scene.carry(id, &self.ray)
            {
                let mut rest = match self.rule {
                    HitRule::Crossing => geometry.all_hits(&carried),
                    HitRule::Touching => geometry.all_touched(&carried),
                };
                if let Some(hit) = rest.next() {
                    self.waiting.push(Waiting { next: self.scene.found(id, hit), rest });
                }
            }
        }
        true
    }
}

/// The instance whose hit comes first is the greatest.
impl<T> Ord for Waiting<'_, T> {
    fn cmp(&self, other: &Self) -> Ordering {
        other.next.order(&self.next)
    }
}

impl<T> PartialOrd for Waiting<'_, T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<T> PartialEq for Waiting<'_, T> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<T> Eq for Waiting<'_, T> {}

impl<T: Precision> FusedIterator for InstanceHits<'_, T> {}

impl<T: Precision> Iterator for InstanceHits<'_, T> {
    type Item = InstanceHit;

    fn next(&mut self) -> Option<InstanceHit> {
        loop {
            let first = self.waiting.peek();
            let is_next = first.is_some_and(|it| it.next.hit.t < self.walk.t_next());
            if is_next || !self.visit_leaf() {
                break;
            }
        }
        let mut first = self.waiting.peek_mut()?;
        let found = first.next;
        match first.rest.next() {
            Some(hit) => first.next = self.scene.found(found.instance_id, hit),
            None => drop(PeekMut::pop(first)),
        }
        Some(found)
    }
}
