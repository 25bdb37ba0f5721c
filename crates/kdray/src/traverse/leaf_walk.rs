//! The stack traversal of a kd-tree (S11; Havran 2000, §4.4; Hapala & Havran 2011).

use super::trace::{LeafStep, SplitStep, Trace, TraversalCase};
use crate::geometry::{Interval, Ray, t_above, t_below};
use crate::primitives::Primitives;
use crate::tree::{KdTree, MAX_DEPTH, NodeKind};
use arrayvec::ArrayVec;

/// The leaves of a tree that a ray passes, front to back.
///
/// Cells are disjoint but for their faces, so leaves come by rising t, with two exceptions: a ray
/// that runs in a split plane passes the cells on both sides of it one side after the other, and
/// near a plane intervals overlap by what rounding may hide. So a later leaf may hold an earlier
/// hit; [`t_next`](Self::t_next) bounds all that are left.
#[derive(Clone, Debug)]
pub struct LeafWalk<'a, const K: usize> {
    tree: &'a KdTree<K>,
    ray: Ray<K>,
    inverse: [f64; K],
    stack: ArrayVec<Waiting, { MAX_DEPTH + 1 }>,
}

/// A node that the ray has yet to visit.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    node: u32,
    t_near: f64,
    t_far: f64,
    /// The least `t_near` of this node and of all that have waited longer.
    t_next: f64,
}

/// A leaf that the ray passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeafVisit<'a> {
    /// The ids of the leaf's primitives.
    pub primitives: &'a [u32],
    /// A bound below every t at which the ray is in the leaf's cell.
    pub t_near: f64,
    /// A bound above every t at which the ray is in the leaf's cell.
    pub t_far: f64,
}

impl<'a, const K: usize> LeafWalk<'a, K> {
    /// A walk along `ray` over a tree of `primitives`, over nothing if [`Ray::check`] refuses it.
    pub fn over(
        tree: &'a KdTree<K>,
        primitives: &impl Primitives<K>,
        ray: &Ray<K>,
        trace: &mut impl Trace,
    ) -> Self {
        Self::seen_as(tree, ray, primitives.ray_in_tree(ray), trace)
    }

    /// A walk along `ray`, which is `in_tree` as the tree sees it, or has numbers that do not fit there.
    pub(crate) fn seen_as(
        tree: &'a KdTree<K>,
        ray: &Ray<K>,
        in_tree: Option<Ray<K>>,
        trace: &mut impl Trace,
    ) -> Self {
        match in_tree {
            None if ray.check().is_ok() => Self::everywhere(tree, ray, trace),
            in_tree => Self::new(tree, &in_tree.unwrap_or(*ray), trace),
        }
    }

    /// A walk over all leaves, for a ray whose numbers do not fit the tree.
    #[cold]
    fn everywhere(tree: &'a KdTree<K>, ray: &Ray<K>, trace: &mut impl Trace) -> Self {
        let Interval { t_min: t_near, t_max: t_far } = Interval::LINE;
        trace.root(Some(Interval::LINE));
        let mut stack = ArrayVec::new();
        stack.push(Waiting { node: 0, t_near, t_far, t_next: t_near });
        // Every split is undecided.
        Self { tree, ray: *ray, inverse: [f64::NAN; K], stack }
    }

    /// A walk along `ray`, which is as the tree sees it, over nothing if [`Ray::check`] refuses it.
    pub fn new(tree: &'a KdTree<K>, ray: &Ray<K>, trace: &mut impl Trace) -> Self {
        let interval = if ray.check().is_ok() { tree.bounds.slab(ray) } else { None };
        trace.root(interval);
        let mut stack = ArrayVec::new();
        if let Some(Interval { t_min: t_near, t_max: t_far }) = interval {
            stack.push(Waiting { node: 0, t_near, t_far, t_next: t_near });
        }
        Self { tree, ray: *ray, inverse: ray.direction.map(inverse), stack }
    }

    /// A bound that no hit in the leaves to come is below; infinite at the end.
    #[inline]
    pub fn t_next(&self) -> f64 {
        self.stack.last().map_or(f64::INFINITY, |waiting| waiting.t_next)
    }

    /// The next leaf, unless the walk is over or no t up to `t_limit` lies in it.
    #[inline]
    pub fn next_leaf(&mut self, t_limit: f64, trace: &mut impl Trace) -> Option<LeafVisit<'a>> {
        let Waiting { mut node, t_near, mut t_far, .. } = self.pop(t_limit, trace)?;
        loop {
            match self.tree.nodes[node as usize].kind() {
                NodeKind::Inner { axis, split, above } => {
                    let split_position = f64::from(split);
                    // For a parallel ray this is infinite, on the side where its origin is not;
                    // for one within the plane 0 · inf = NaN: no comparison below holds, and both
                    // children are visited in the whole interval.
                    let t_split = (split_position - self.ray.origin[axis]) * self.inverse[axis];
                    let forward = self.inverse[axis] > 0.0;
                    let (near, far) = if forward { (node + 1, above) } else { (above, node + 1) };
                    let case = if t_split > t_far {
                        TraversalCase::NearOnly
                    } else if t_split < t_near {
                        TraversalCase::FarOnly
                    } else {
                        TraversalCase::NearThenFar
                    };
                    let entered = SplitStep {
                        node,
                        axis,
                        split,
                        t_near,
                        t_split,
                        t_far,
                        case,
                        near_child: near,
                        far_child: far,
                        stack_depth: self.stack.len()
                            + usize::from(case == TraversalCase::NearThenFar),
                    };
                    trace.split(&entered);
                    match case {
                        TraversalCase::NearOnly => node = near,
                        TraversalCase::FarOnly => node = far,
                        TraversalCase::NearThenFar => {
                            self.push(far, t_below(t_split).max(t_near), t_far);
                            t_far = t_above(t_split).min(t_far);
                            node = near;
                        }
                    }
                }
                NodeKind::Leaf { .. } => {
                    let primitives = self.tree.leaf_primitives(node);
                    let stack_depth = self.stack.len();
                    let count = primitives.len();
                    trace.leaf(&LeafStep { node, t_near, t_far, primitives: count, stack_depth });
                    return Some(LeafVisit { primitives, t_near, t_far });
                }
            }
        }
    }

    /// Lets a node wait.
    #[inline]
    fn push(&mut self, node: u32, t_near: f64, t_far: f64) {
        let t_next = t_near.min(self.t_next());
        self.stack.push(Waiting { node, t_near, t_far, t_next });
    }

    /// The node that has waited shortest of those that begin before `t_limit`.
    #[inline]
    fn pop(&mut self, t_limit: f64, trace: &mut impl Trace) -> Option<Waiting> {
        while let Some(waiting) = self.stack.pop() {
            if waiting.t_near <= t_limit {
                trace.pop(waiting.node, waiting.t_near);
                return Some(waiting);
            }
            if waiting.t_next > t_limit {
                self.stack.clear();
                trace.finish_early(t_limit, waiting.t_next);
            }
        }
        None
    }
}

/// 1 / d, infinite with the sign of d for both zeros. NaN, which makes every split of the axis
/// undecided, for a d so small that its inverse overflows.
pub(super) fn inverse(d: f64) -> f64 {
    let inverse = 1.0 / d;
    if inverse.is_infinite() && d != 0.0 { f64::NAN } else { inverse }
}
