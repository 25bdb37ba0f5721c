//! Any primitives with a tree over them.

use crate::build::{BuildError, BuildOptions, BuildProgress};
use crate::geometry::{Aabb, Ray};
use crate::primitives::{Hit, HitRule, Intersect, TriangleMesh};
use crate::traverse::{self, AllHits, Cull, Naive, PacketKind, Packets, Trace};
use crate::tree::KdTree;
use std::ops::ControlFlow;

/// Any primitives with a kd-tree over them, in K dimensions, ready for queries from any thread: the
/// scalar traversal of the canonical tree, which can be watched.
///
/// A ray that [`Ray::check`] refuses hits nothing. Primitives are tested one by one, so trees by
/// [`BuildOptions::for_strategy`] suit it best. For triangle meshes [`Scene`](crate::Scene) gives
/// the same answers faster.
///
/// ```
/// use kdray::primitives::Balls;
/// use kdray::{BuildOptions, Ray, ShapeScene, Strategy};
/// let balls = Balls::new(vec![([0.0, 0.0, 5.0], 1.0)])?;
/// let scene = ShapeScene::build(balls, &BuildOptions::for_strategy(Strategy::Sah))?;
/// let hit = scene.closest_hit(&Ray::new([0.0; 3], [0.0, 0.0, 1.0])).expect("a ball is ahead");
/// assert_eq!(hit.t, 4.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct ShapeScene<P = TriangleMesh, const K: usize = 3> {
    primitives: P,
    tree: KdTree<K>,
}

impl<P: Intersect<K>, const K: usize> ShapeScene<P, K> {
    /// Builds a tree over `primitives`.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build(primitives: P, options: &BuildOptions) -> Result<Self, BuildError> {
        Self::build_with_progress(primitives, options, &|_| ControlFlow::Continue(()))
    }

    /// Builds a tree over `primitives`, tells `progress` how far it is, and stops if that answers
    /// [`ControlFlow::Break`].
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build_with_progress(
        primitives: P,
        options: &BuildOptions,
        progress: &(dyn Fn(BuildProgress) -> ControlFlow<()> + Sync),
    ) -> Result<Self, BuildError> {
        let tree = KdTree::build_with_progress(&primitives, options, progress)?;
        Ok(Self::of_tree(primitives, tree))
    }

    /// Takes a tree over `primitives` as it is.
    pub(super) fn of_tree(primitives: P, tree: KdTree<K>) -> Self {
        Self { primitives, tree }
    }

    /// What rays are tested against.
    pub fn primitives(&self) -> &P {
        &self.primitives
    }

    /// Gives the primitives back.
    pub fn into_primitives(self) -> P {
        self.primitives
    }

    /// The tree.
    pub fn tree(&self) -> &KdTree<K> {
        &self.tree
    }

    /// The same queries without the tree.
    pub fn naive(&self) -> Naive<'_, P, Aabb<K>> {
        Naive::new(&self.primitives, *self.tree.bounds())
    }

    /// The hit of least t; of several at the same t, the one of the smallest primitive id.
    #[must_use]
    pub fn closest_hit(&self, ray: &Ray<K>) -> Option<Hit> {
        self.closest_hit_traced(ray, &mut ())
    }

    /// [`closest_hit`](Self::closest_hit), watched by `trace`.
    pub fn closest_hit_traced(&self, ray: &Ray<K>, trace: &mut impl Trace) -> Option<Hit> {
        traverse::closest_hit(&self.tree, &self.primitives, ray, trace)
    }

    /// Whether there is any hit: whether `ray.interval` is occluded.
    #[must_use]
    pub fn any_hit(&self, ray: &Ray<K>) -> bool {
        self.any_hit_traced(ray, &mut ())
    }

    /// [`any_hit`](Self::any_hit), watched by `trace`.
    pub fn any_hit_traced(&self, ray: &Ray<K>, trace: &mut impl Trace) -> bool {
        traverse::any_hit(&self.tree, &self.primitives, ray, trace).is_some()
    }

    /// What [`any_hit`](Self::any_hit) found: some hit, not necessarily the first, but the same
    /// one on every run.
    #[must_use]
    pub fn occluder(&self, ray: &Ray<K>) -> Option<Hit> {
        traverse::any_hit(&self.tree, &self.primitives, ray, &mut ())
    }

    /// Every crossing of a surface, once, by rising t ([`HitRule::Crossing`]), found as they are
    /// asked for.
    pub fn all_hits(&self, ray: &Ray<K>) -> AllHits<'_, P, K> {
        self.all_hits_traced(ray, HitRule::Crossing, ())
    }

    /// Every primitive that the ray touches, by rising t ([`HitRule::Touching`]): on a shared edge
    /// each of its primitives.
    pub fn all_touched(&self, ray: &Ray<K>) -> AllHits<'_, P, K> {
        self.all_hits_traced(ray, HitRule::Touching, ())
    }

    /// The crossings of [`all_hits`](Self::all_hits) that come after `last`, one of them.
    pub fn all_hits_after(&self, ray: &Ray<K>, last: &Hit) -> AllHits<'_, P, K> {
        AllHits::after(&self.tree, &self.primitives, ray, HitRule::Crossing, last, ())
    }

    /// What [`all_touched`](Self::all_touched) finds after `last`, one of its hits.
    pub fn all_touched_after(&self, ray: &Ray<K>, last: &Hit) -> AllHits<'_, P, K> {
        AllHits::after(&self.tree, &self.primitives, ray, HitRule::Touching, last, ())
    }

    /// The first hit that `keep` keeps, by rising t, equal t by rising primitive id.
    pub fn closest_hit_where(
        &self,
        ray: &Ray<K>,
        mut keep: impl FnMut(&Hit) -> bool,
    ) -> Option<Hit> {
        self.all_touched(ray).find(|hit| keep(hit))
    }

    /// All hits that count by `rule`, watched by `trace`.
    pub fn all_hits_traced<T: Trace>(
        &self,
        ray: &Ray<K>,
        rule: HitRule,
        trace: T,
    ) -> AllHits<'_, P, K, T> {
        AllHits::new(&self.tree, &self.primitives, ray, rule, trace)
    }

    /// How many surfaces the ray crosses: the number of [`all_hits`](Self::all_hits). On a closed
    /// mesh it is even for a ray from outside without end, and odd for one from inside, unless the direction is so
    /// short that some t is beyond f64.
    #[must_use]
    pub fn count(&self, ray: &Ray<K>) -> usize {
        self.all_hits(ray).count()
    }
}

impl<P: Cull> ShapeScene<P, 3> {
    /// The same closest and any hits for rays that are taken together, in packets that can be
    /// watched.
    pub fn packets(&self, kind: PacketKind) -> Packets<'_, P> {
        Packets::new(&self.tree, &self.primitives, kind)
    }
}
