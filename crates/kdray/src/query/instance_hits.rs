//! All hits on instances, in order, as they are asked for.

use super::{InstanceHit, InstancedScene, Precision};
use crate::geometry::Ray;
use crate::primitives::{HitRule, TriangleMesh};
use crate::traverse::{AllHits, LeafWalk};
use std::collections::HashSet;
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
    begun: HashSet<u32>,
    /// Those that have a next hit.
    waiting: Vec<Waiting<'a, T>>,
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
        let (begun, waiting) = (HashSet::new(), Vec::new());
        Self { scene, ray: *ray, rule, walk, begun, waiting }
    }

    /// Begins with the instances of the next leaf; false if there is none.
    fn visit_leaf(&mut self) -> bool {
        let Some(leaf) = self.walk.next_leaf(self.ray.interval.t_max, &mut ()) else {
            return false;
        };
        for &id in leaf.primitives {
            if self.begun.insert(id)
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

    /// The place of the instance whose next hit comes first.
    fn first(&self) -> Option<usize> {
        let places = 0..self.waiting.len();
        places.min_by(|&a, &b| self.waiting[a].next.order(&self.waiting[b].next))
    }
}

impl<T: Precision> FusedIterator for InstanceHits<'_, T> {}

impl<T: Precision> Iterator for InstanceHits<'_, T> {
    type Item = InstanceHit;

    fn next(&mut self) -> Option<InstanceHit> {
        let place = loop {
            let first = self.first();
            let is_next = first.is_some_and(|it| self.waiting[it].next.hit.t < self.walk.t_next());
            if is_next || !self.visit_leaf() {
                break self.first()?;
            }
        };
        let Waiting { next, rest } = &mut self.waiting[place];
        let found = *next;
        match rest.next() {
            Some(hit) => *next = self.scene.found(found.instance_id, hit),
            None => drop(self.waiting.swap_remove(place)),
        }
        Some(found)
    }
}
