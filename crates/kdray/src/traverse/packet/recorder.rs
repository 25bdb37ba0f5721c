//! All steps of packets, kept.

use super::frustum::Frustum;
use super::trace::{PacketLeafStep, PacketSplitStep, PacketTrace};
use crate::traverse::Counters;

/// One thing that a packet did; see [`PacketTrace`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PacketStep {
    /// A packet of so many rays begins.
    Packet(usize),
    /// A lane's frustum.
    Frustum(Frustum),
    /// An inner node was visited.
    Split(PacketSplitStep),
    /// A leaf was visited.
    Leaf(PacketLeafStep),
    /// The bound alone told that no ray hits this primitive.
    Culled(u32),
    /// This primitive is set up to be tested.
    SetUp(u32),
    /// A ray was tested against a primitive.
    Test {
        /// The primitive's index.
        id: u32,
        /// The ray's place.
        ray: usize,
        /// The parameter of its hit, if any.
        t: Option<f64>,
    },
    /// A waiting node was taken from the stack.
    Pop {
        /// The node's index.
        node: u32,
        /// The least t_near of its lanes.
        t_near: f64,
    },
    /// This waiting node was dropped.
    Dropped(u32),
    /// This ray was left to the single traversal.
    Left(usize),
}

/// Keeps every step of packets.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PacketRecorder {
    /// The steps in the order they were taken.
    pub steps: Vec<PacketStep>,
}

impl PacketTrace for PacketRecorder {
    fn packet(&mut self, rays: usize) {
        self.steps.push(PacketStep::Packet(rays));
    }

    fn frustum(&mut self, _lane: usize, frustum: &Frustum) {
        self.steps.push(PacketStep::Frustum(*frustum));
    }

    fn split(&mut self, step: &PacketSplitStep) {
        self.steps.push(PacketStep::Split(*step));
    }

    fn leaf(&mut self, step: &PacketLeafStep) {
        self.steps.push(PacketStep::Leaf(*step));
    }

    fn culled(&mut self, id: u32) {
        self.steps.push(PacketStep::Culled(id));
    }

    fn set_up(&mut self, id: u32) {
        self.steps.push(PacketStep::SetUp(id));
    }

    fn test(&mut self, id: u32, ray: usize, t: Option<f64>) {
        self.steps.push(PacketStep::Test { id, ray, t });
    }

    fn pop(&mut self, node: u32, t_near: f64) {
        self.steps.push(PacketStep::Pop { node, t_near });
    }

    fn dropped(&mut self, node: u32) {
        self.steps.push(PacketStep::Dropped(node));
    }

    fn left(&mut self, ray: usize, _cost: &Counters) {
        self.steps.push(PacketStep::Left(ray));
    }
}
