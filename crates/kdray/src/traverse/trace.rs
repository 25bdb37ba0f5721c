//! Watching a traversal: counts for heat maps, steps for lectures.

use crate::geometry::Interval;
use std::iter::Sum;

/// The lecture's cases of S11: how t_split lies to the node's interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TraversalCase {
    /// t_split > t_far: go on in the near child, drop the far one.
    NearOnly,
    /// t_near ≤ t_split ≤ t_far: the near child first, the far child onto the stack.
    NearThenFar,
    /// t_split < t_near: only the far child.
    FarOnly,
}

/// A visit of an inner node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplitStep {
    /// The node's index.
    pub node: u32,
    /// The axis that the plane is perpendicular to.
    pub axis: usize,
    /// Where the plane lies on it.
    pub split: f32,
    /// Where the ray enters the node's box.
    pub t_near: f64,
    /// Where the ray meets the plane: infinite for a ray parallel to it, NaN for one within it.
    pub t_split: f64,
    /// Where the ray leaves the node's box.
    pub t_far: f64,
    /// Which children are visited.
    pub case: TraversalCase,
    /// The child that the ray meets first.
    pub near_child: u32,
    /// The other child.
    pub far_child: u32,
    /// How many nodes wait on the stack after this step.
    pub stack_depth: usize,
}

/// A visit of a leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeafStep {
    /// The node's index.
    pub node: u32,
    /// Where the ray enters the leaf's box.
    pub t_near: f64,
    /// Where the ray leaves it.
    pub t_far: f64,
    /// How many primitives the leaf lists.
    pub primitives: usize,
    /// How many nodes wait on the stack.
    pub stack_depth: usize,
}

/// Something that watches one query. Every method does nothing by default, and `()` watches
/// nothing at no cost.
pub trait Trace {
    /// The root's box was tested: the ray's interval in it, or `None` for a miss.
    fn root(&mut self, _interval: Option<Interval>) {}
    /// An inner node was visited.
    fn split(&mut self, _step: &SplitStep) {}
    /// A leaf was visited.
    fn leaf(&mut self, _step: &LeafStep) {}
    /// A primitive was tested; `t` is that of its hit, if any.
    fn primitive(&mut self, _id: u32, _t: Option<f64>) {}
    /// A waiting node was taken from the stack.
    fn pop(&mut self, _node: u32, _t_near: f64) {}
    /// The waiting nodes were dropped: the best hit, at `t`, is nearer than the next, at `t_near`.
    fn finish_early(&mut self, _t: f64, _t_near: f64) {}
}

impl Trace for () {}

/// So that [`AllHits`](super::AllHits), which owns its watcher, can be lent one.
impl<T: Trace + ?Sized> Trace for &mut T {
    fn root(&mut self, interval: Option<Interval>) {
        (**self).root(interval);
    }

    fn split(&mut self, step: &SplitStep) {
        (**self).split(step);
    }

    fn leaf(&mut self, step: &LeafStep) {
        (**self).leaf(step);
    }

    fn primitive(&mut self, id: u32, t: Option<f64>) {
        (**self).primitive(id, t);
    }

    fn pop(&mut self, node: u32, t_near: f64) {
        (**self).pop(node, t_near);
    }

    fn finish_early(&mut self, t: f64, t_near: f64) {
        (**self).finish_early(t, t_near);
    }
}

/// Counts what a query costs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Inner nodes visited.
    pub splits: u64,
    /// Leaves visited.
    pub leaves: u64,
    /// Primitives tested, as often as they were.
    pub primitives: u64,
}

impl Counters {
    /// Inner nodes and leaves visited.
    pub fn nodes(&self) -> u64 {
        self.splits + self.leaves
    }
}

impl Sum for Counters {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), |sum, next| Self {
            splits: sum.splits + next.splits,
            leaves: sum.leaves + next.leaves,
            primitives: sum.primitives + next.primitives,
        })
    }
}

impl Trace for Counters {
    fn split(&mut self, _step: &SplitStep) {
        self.splits += 1;
    }

    fn leaf(&mut self, _step: &LeafStep) {
        self.leaves += 1;
    }

    fn primitive(&mut self, _id: u32, _t: Option<f64>) {
        self.primitives += 1;
    }
}

/// One thing that a traversal did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// The root's box was tested: the ray's interval in it, or `None` for a miss.
    Root(Option<Interval>),
    /// An inner node was visited.
    Split(SplitStep),
    /// A leaf was visited.
    Leaf(LeafStep),
    /// A primitive was tested.
    Primitive {
        /// Its index.
        id: u32,
        /// The parameter of its hit, if any.
        t: Option<f64>,
    },
    /// A waiting node was taken from the stack.
    Pop {
        /// The node's index.
        node: u32,
        /// Where the ray enters its box.
        t_near: f64,
    },
    /// The waiting nodes were dropped, because a hit at `t` is nearer than the next of them.
    FinishEarly {
        /// The best hit's parameter.
        t: f64,
        /// Where the ray enters the next node that waited.
        t_near: f64,
    },
}

/// Keeps every step of a query.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StepRecorder {
    /// The steps in the order they were taken.
    pub steps: Vec<Step>,
}

impl Trace for StepRecorder {
    fn root(&mut self, interval: Option<Interval>) {
        self.steps.push(Step::Root(interval));
    }

    fn split(&mut self, step: &SplitStep) {
        self.steps.push(Step::Split(*step));
    }

    fn leaf(&mut self, step: &LeafStep) {
        self.steps.push(Step::Leaf(*step));
    }

    fn primitive(&mut self, id: u32, t: Option<f64>) {
        self.steps.push(Step::Primitive { id, t });
    }

    fn pop(&mut self, node: u32, t_near: f64) {
        self.steps.push(Step::Pop { node, t_near });
    }

    fn finish_early(&mut self, t: f64, t_near: f64) {
        self.steps.push(Step::FinishEarly { t, t_near });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Aabb, Ray};
    use crate::primitives::{HitRule, Segments};
    use crate::traverse::{AllHits, any_hit, closest_hit};
    use crate::tree::{KdTree, Node};

    /// Uprights at x = 0.5 and 1.5, a plane between them at 1.
    fn two_uprights() -> (KdTree<2>, Segments) {
        let tree = KdTree {
            bounds: Aabb { min: [0.0; 2], max: [2.0, 1.0] },
            nodes: vec![Node::inner(0, 1.0, 2), Node::leaf(0, 1), Node::leaf(1, 1)].into(),
            references: vec![0, 1].into(),
        };
        let upright = |x| [[x, 0.0], [x, 1.0]];
        (tree, Segments::new(vec![upright(0.5), upright(1.5)]).unwrap())
    }

    const FROM_THE_LEFT: [[f64; 2]; 2] = [[-1.0, 0.5], [1.0, 0.0]];

    /// What was done, in a word each.
    fn words(recorder: &StepRecorder) -> Vec<String> {
        let word = |step: &Step| match step {
            Step::Root(interval) => format!("root {}", interval.is_some()),
            Step::Split(step) => format!("{:?} {}", step.case, step.stack_depth),
            Step::Leaf(step) => format!("leaf {}", step.node),
            Step::Primitive { id, t } => format!("primitive {id} {t:?}"),
            Step::Pop { node, .. } => format!("pop {node}"),
            Step::FinishEarly { t, .. } => format!("finish {t}"),
        };
        recorder.steps.iter().map(word).collect()
    }

    #[test]
    fn every_step_of_every_query_is_recorded() {
        let (tree, uprights) = two_uprights();
        let [origin, direction] = FROM_THE_LEFT;
        let ray = Ray::new(origin, direction);
        let start = ["root true", "pop 0", "NearThenFar 1", "leaf 1", "primitive 0 Some(1.5)"];
        let mut seen = StepRecorder::default();
        closest_hit(&tree, &uprights, &ray, &mut seen);
        assert_eq!(words(&seen), [&start[..], &["finish 1.5"]].concat());
        let mut seen = StepRecorder::default();
        any_hit(&tree, &uprights, &ray, &mut seen);
        assert_eq!(words(&seen), start);
        let mut seen = StepRecorder::default();
        assert_eq!(AllHits::new(&tree, &uprights, &ray, HitRule::Crossing, &mut seen).count(), 2);
        let rest = ["pop 2", "leaf 2", "primitive 1 Some(2.5)"];
        assert_eq!(words(&seen), [&start[..], &rest].concat());
    }

    #[test]
    fn the_cases_are_the_lectures() {
        let (tree, uprights) = two_uprights();
        let [origin, direction] = FROM_THE_LEFT;
        let case = |t_min, t_max| {
            let mut seen = StepRecorder::default();
            let ray = Ray::new(origin, direction).with_interval(t_min, t_max);
            closest_hit(&tree, &uprights, &ray, &mut seen);
            let split = |step: &Step| match step {
                Step::Split(step) => Some((step.case, step.t_split)),
                _ => None,
            };
            seen.steps.iter().find_map(split).unwrap()
        };
        assert_eq!(case(0.0, 9.0), (TraversalCase::NearThenFar, 2.0));
        assert_eq!(case(0.0, 1.9), (TraversalCase::NearOnly, 2.0));
        assert_eq!(case(2.1, 9.0), (TraversalCase::FarOnly, 2.0));
    }

    #[test]
    fn counters_count_what_the_steps_show() {
        let (tree, uprights) = two_uprights();
        let [origin, direction] = FROM_THE_LEFT;
        let mut counters = Counters::default();
        let ray = Ray::new(origin, direction);
        AllHits::new(&tree, &uprights, &ray, HitRule::Crossing, &mut counters).for_each(drop);
        assert_eq!(counters, Counters { splits: 1, leaves: 2, primitives: 2 });
        assert_eq!(counters.nodes(), 3);
    }
}
