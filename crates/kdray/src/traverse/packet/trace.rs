//! Watching a packet: counts for tables, steps for lectures and pictures.

use super::frustum::Frustum;
use super::lanes::LaneMask;
use crate::traverse::Counters;
use std::iter::Sum;

/// Where a packet goes from a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PacketDecision {
    /// No ray can be in either child.
    Neither,
    /// Only the near child.
    Near,
    /// Only the far child.
    Far,
    /// The near child first, the far child onto the stack.
    Both,
}

/// A decision at an inner node. The t are those of the kind of packet: of a frustum depths on the
/// dominant axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PacketSplitStep {
    /// The node's index.
    pub node: u32,
    /// The axis that the plane is perpendicular to.
    pub axis: usize,
    /// Where the plane lies on it.
    pub split: f32,
    /// The least t_near of the lanes in the node.
    pub t_near: f64,
    /// The greatest t_far of the lanes in the node.
    pub t_far: f64,
    /// The lanes in the node.
    pub lanes: LaneMask,
    /// Those that may be in the near child.
    pub near_lanes: LaneMask,
    /// Those that may be in the far child.
    pub far_lanes: LaneMask,
    /// The child that the packet meets first.
    pub near_child: u32,
    /// The other child.
    pub far_child: u32,
    /// How many nodes wait on the stack after this step.
    pub stack_depth: usize,
}

impl PacketSplitStep {
    /// Where the packet goes.
    pub fn decision(&self) -> PacketDecision {
        match (self.near_lanes.is_empty(), self.far_lanes.is_empty()) {
            (true, true) => PacketDecision::Neither,
            (false, true) => PacketDecision::Near,
            (true, false) => PacketDecision::Far,
            (false, false) => PacketDecision::Both,
        }
    }
}

/// A visit of a leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PacketLeafStep {
    /// The node's index.
    pub node: u32,
    /// The least t_near of the lanes in the leaf.
    pub t_near: f64,
    /// The greatest t_far of the lanes in the leaf.
    pub t_far: f64,
    /// The lanes in the leaf.
    pub lanes: LaneMask,
    /// How many primitives the leaf lists.
    pub primitives: usize,
    /// How many nodes wait on the stack.
    pub stack_depth: usize,
}

/// Something that watches packets. Every method does nothing by default, and `()` watches nothing
/// at no cost. Rays are named by their place in the slice that was asked.
pub trait PacketTrace {
    /// A packet begins, of so many rays that meet the tree's box and fit together.
    fn packet(&mut self, _rays: usize) {}
    /// A lane's frustum, for packets that have some.
    fn frustum(&mut self, _lane: usize, _frustum: &Frustum) {}
    /// An inner node was visited.
    fn split(&mut self, _step: &PacketSplitStep) {}
    /// A leaf was visited.
    fn leaf(&mut self, _step: &PacketLeafStep) {}
    /// The bound alone told that no ray hits a primitive.
    fn culled(&mut self, _id: u32) {}
    /// A primitive got through the culling: it is set up to be tested.
    fn set_up(&mut self, _id: u32) {}
    /// A ray was tested against a primitive; `t` is that of its hit, if any.
    fn test(&mut self, _id: u32, _ray: usize, _t: Option<f64>) {}
    /// A waiting node was taken from the stack.
    fn pop(&mut self, _node: u32, _t_near: f64) {}
    /// A waiting node was dropped: each lane has found all it seeks before.
    fn dropped(&mut self, _node: u32) {}
    /// A ray did not fit the packet; the single traversal answered it, at this cost.
    fn left(&mut self, _ray: usize, _cost: &Counters) {}
}

impl PacketTrace for () {}

/// Counts what packets cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PacketCounters {
    /// Packets of at least one ray.
    pub packets: u64,
    /// Decisions at inner nodes, each for a whole packet.
    pub decisions: u64,
    /// Leaves visited by packets.
    pub leaves: u64,
    /// Primitives that the bound alone told to be missed.
    pub culled: u64,
    /// Primitives that got through the culling, as often as they did.
    pub set_ups: u64,
    /// Tests of a ray against a primitive.
    pub tests: u64,
    /// Rays that were left to the single traversal.
    pub left: u64,
    /// What these cost.
    pub single: Counters,
}

impl Sum for PacketCounters {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), |sum, next| Self {
            packets: sum.packets + next.packets,
            decisions: sum.decisions + next.decisions,
            leaves: sum.leaves + next.leaves,
            culled: sum.culled + next.culled,
            set_ups: sum.set_ups + next.set_ups,
            tests: sum.tests + next.tests,
            left: sum.left + next.left,
            single: [sum.single, next.single].into_iter().sum(),
        })
    }
}

impl PacketTrace for PacketCounters {
    fn packet(&mut self, _rays: usize) {
        self.packets += 1;
    }

    fn split(&mut self, _step: &PacketSplitStep) {
        self.decisions += 1;
    }

    fn leaf(&mut self, _step: &PacketLeafStep) {
        self.leaves += 1;
    }

    fn culled(&mut self, _id: u32) {
        self.culled += 1;
    }

    fn set_up(&mut self, _id: u32) {
        self.set_ups += 1;
    }

    fn test(&mut self, _id: u32, _ray: usize, _t: Option<f64>) {
        self.tests += 1;
    }

    fn left(&mut self, _ray: usize, cost: &Counters) {
        self.left += 1;
        self.single = [self.single, *cost].into_iter().sum();
    }
}
