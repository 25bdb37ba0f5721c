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
    /// The hits of those that are waiting, after their next one.
    rests: Vec<AllHits<'a, TriangleMesh<T>, 3>>,
    /// Places among them whose hits have come to an end.
    free: Vec<usize>,
    /// The next hits of those that have one, the first of which is on top.
    waiting: BinaryHeap<Waiting>,
}

/// The next hit of an instance, and where those after it are: they are many bytes, which the heap does not move.
#[derive(Debug)]
struct Waiting {
    next: InstanceHit,
    rest: usize,
}

impl<'a, T: Precision> InstanceHits<'a, T> {
    pub(super) fn new(scene: &'a InstancedScene<T>, ray: &Ray, rule: HitRule) -> Self {
        let walk = scene.walk(ray);
        let (begun, waiting) = (Asked::default(), BinaryHeap::new());
        let (rests, free) = (Vec::new(), Vec::new());
        Self { scene, ray: *ray, rule, walk, begun, rests, free, waiting }
    }

    /// Begins with the instances of the next leaf; false if there is none.
    fn visit_leaf(&mut self) -> bool {
        let Some(leaf) = self.walk.next_leaf(self.ray.interval.t_max, &mut ()) else {
            return false;
        };
        for &id in leaf.primitives {
            if self.scene.sees(id) && self.begun.is_new(id) {
                self.begin(id);
            }
        }
        true
    }

    fn begin(&mut self, id: u32) {
        let (geometry, carried) = self.scene.carry(id, &self.ray);
        let mut rest = match self.rule {
            HitRule::Crossing => geometry.all_hits(&carried),
            HitRule::Touching => geometry.all_touched(&carried),
        };
        if let Some(hit) = rest.next() {
            let next = self.scene.found(id, hit);
            let rest = self.keep(rest);
            self.waiting.push(Waiting { next, rest });
        }
    }

    /// Puts hits into a place, which it tells.
    fn keep(&mut self, rest: AllHits<'a, TriangleMesh<T>, 3>) -> usize {
        if let Some(place) = self.free.pop() {
            self.rests[place] = rest;
            return place;
        }
        self.rests.push(rest);
        self.rests.len() - 1
    }
}

/// The instance whose hit comes first is the greatest.
impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        other.next.order(&self.next)
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Waiting {}

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
        match self.rests[first.rest].next() {
            Some(hit) => first.next = self.scene.found(found.instance_id, hit),
            None => self.free.push(PeekMut::pop(first).rest),
        }
        Some(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BuildOptions, Instance, Scene};

    #[test]
    fn what_has_ended_makes_room() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0_f32]];
        let mesh = TriangleMesh::from_soup([corners]).unwrap();
        let geometry = Scene::build(mesh, &BuildOptions::default()).unwrap();
        let row = (0..1000).map(|i| {
            let to_world =
                [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, f64::from(i)]];
            Instance { to_world, ..Instance::of(0) }
        });
        let scene = InstancedScene::build(vec![geometry], row.collect()).unwrap();
        let mut hits = scene.all_hits(&Ray::new([0.25, 0.25, -1.0], [0.0, 0.0, 1.0]));
        assert_eq!(hits.by_ref().count(), 1000);
        assert!(hits.rests.len() < 10, "{}", hits.rests.len());
    }
}
