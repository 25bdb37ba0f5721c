//! The answer without a tree: every primitive is tested.

use crate::geometry::{BoundingVolume, Ray};
use crate::primitives::{Hit, HitRule, Intersect};

/// The same queries as a scene's, by testing each primitive after the object's bounding volume
/// (S1). Slow, and therefore what every tree and traversal is compared with.
#[derive(Clone, Copy, Debug)]
pub struct Naive<'a, P, V> {
    primitives: &'a P,
    volume: V,
}

impl<'a, P, V> Naive<'a, P, V> {
    /// Queries on `primitives`, all of which lie in `volume`, which is as their tree sees it.
    pub fn new(primitives: &'a P, volume: V) -> Self {
        Self { primitives, volume }
    }

    /// Gives `report` every hit that counts by `rule`, in no order.
    fn each_hit<const K: usize>(&self, ray: &Ray<K>, rule: HitRule, mut report: impl FnMut(Hit))
    where
        P: Intersect<K>,
        V: BoundingVolume<K>,
    {
        let passes = |in_tree: Ray<K>| self.volume.ray_interval(&in_tree).is_none();
        if ray.check().is_err() || self.primitives.ray_in_tree(ray).is_some_and(passes) {
            return;
        }
        for id in 0..self.primitives.count() as u32 {
            self.primitives.intersect(id, ray, rule, &mut report);
        }
    }

    /// The hit of least t; of several at the same t, the one of the smallest primitive id.
    pub fn closest_hit<const K: usize>(&self, ray: &Ray<K>) -> Option<Hit>
    where
        P: Intersect<K>,
        V: BoundingVolume<K>,
    {
        let mut best: Option<Hit> = None;
        self.each_hit(ray, HitRule::Touching, |hit| {
            if best.is_none_or(|best| hit.precedes(&best)) {
                best = Some(hit);
            }
        });
        best
    }

    /// Whether there is any hit.
    pub fn any_hit<const K: usize>(&self, ray: &Ray<K>) -> bool
    where
        P: Intersect<K>,
        V: BoundingVolume<K>,
    {
        self.closest_hit(ray).is_some()
    }

    /// All hits that count by `rule`, by rising t, equal t by rising primitive id.
    pub fn all_hits<const K: usize>(&self, ray: &Ray<K>, rule: HitRule) -> Vec<Hit>
    where
        P: Intersect<K>,
        V: BoundingVolume<K>,
    {
        let mut hits = Vec::new();
        self.each_hit(ray, rule, |hit| hits.push(hit));
        hits.sort_by(Hit::order);
        hits
    }
}
