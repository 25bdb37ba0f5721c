//! The stack traversal of a packet: the single one (S11), with lanes in place of the ray.

use super::bound::Bound;
use super::cull::Cull;
use super::lanes::{Inside, LANES, LaneMask};
use super::mailbox::Mailbox;
use super::rays::{PacketRay, Query};
use super::trace::{PacketLeafStep, PacketSplitStep, PacketTrace};
use crate::geometry::Interval;
use crate::tree::{KdTree, MAX_DEPTH, NodeKind};
use arrayvec::ArrayVec;

/// A packet on its way through a tree.
pub(super) struct PacketWalk<'a, B, P> {
    tree: &'a KdTree<3>,
    primitives: &'a P,
    query: Query,
    lanes: ArrayVec<Lane<'a, B>, LANES>,
    mailbox: Mailbox,
    stack: ArrayVec<Waiting, { MAX_DEPTH + 1 }>,
}

/// Rays under one bound.
struct Lane<'a, B> {
    bound: B,
    rays: &'a mut [PacketRay],
    /// Up to which t some ray is open.
    reach: f64,
}

/// A node that the packet has yet to visit.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    node: u32,
    inside: Inside,
}

impl<'a, B: Bound, P: Cull> PacketWalk<'a, B, P> {
    /// A walk of `rays`, all of which fit what they share. `size` is that of a whole packet, whose
    /// rays are dealt out to the lanes by their places.
    pub(super) fn new(
        (tree, primitives): (&'a KdTree<3>, &'a P),
        rays: &'a mut [PacketRay],
        shared: &B::Shared,
        size: usize,
        query: Query,
        trace: &mut impl PacketTrace,
    ) -> Self {
        trace.packet(rays.len());
        let lane_size = B::lane_size(size);
        let lane_of = |ray: &PacketRay| ray.index % size / lane_size;
        let groups = rays.chunk_by_mut(|a, b| lane_of(a) == lane_of(b));
        let lane = |rays: &'a mut [PacketRay]| Lane {
            bound: B::around(shared, rays),
            rays,
            reach: f64::INFINITY,
        };
        let lanes: ArrayVec<Lane<'a, B>, LANES> = groups.map(lane).collect();
        let mut inside = Inside([Interval::EMPTY; LANES]);
        for (number, lane) in lanes.iter().enumerate() {
            inside.0[number] = lane.bound.inside_root(lane.rays);
            if let Some(frustum) = lane.bound.as_frustum() {
                trace.frustum(number, frustum);
            }
        }
        let stack = ArrayVec::from_iter([Waiting { node: 0, inside }]);
        Self { tree, primitives, query, lanes, mailbox: Mailbox::new(), stack }
    }

    /// Visits all nodes that rays may be in before the hits that they have found.
    pub(super) fn run(mut self, trace: &mut impl PacketTrace) {
        while let Some(Waiting { node, inside }) = self.stack.pop() {
            let inside = self.open_part(&inside);
            if inside.lanes().is_empty() {
                trace.dropped(node);
            } else {
                trace.pop(node, inside.hull().t_min);
                self.descend(node, inside, trace);
            }
        }
    }

    /// The lanes of which some ray is still open where they enter.
    fn open_part(&self, inside: &Inside) -> Inside {
        let mut open = *inside;
        for (part, lane) in open.0.iter_mut().zip(&self.lanes) {
            if part.t_min > lane.reach {
                *part = Interval::EMPTY;
            }
        }
        open
    }

    /// Goes down to a leaf, or to where the bounds leave both children out.
    fn descend(&mut self, mut node: u32, mut inside: Inside, trace: &mut impl PacketTrace) {
        while let NodeKind::Inner { axis, split, above } = self.tree.nodes[node as usize].kind() {
            match self.decide(node, (axis, split, above), &inside, trace) {
                Some(child) => (node, inside) = child,
                None => return,
            }
        }
        self.visit_leaf(node, &inside, trace);
    }

    /// Where to go from an inner node: to the child returned, while the other one may wait.
    fn decide(
        &mut self,
        node: u32,
        (axis, split, above): (usize, f32, u32),
        inside: &Inside,
        trace: &mut impl PacketTrace,
    ) -> Option<(u32, Inside)> {
        let [in_near, in_far] = self.children(axis, split.into(), inside);
        let (near_lanes, far_lanes) = (in_near.lanes(), in_far.lanes());
        let (below, bound) = (node + 1, &self.lanes[0].bound);
        let lower_is_near = bound.lower_is_near(axis, split.into());
        let (near, far) = if lower_is_near { (below, above) } else { (above, below) };
        if !near_lanes.is_empty() && !far_lanes.is_empty() {
            self.stack.push(Waiting { node: far, inside: in_far });
        }
        let Interval { t_min: t_near, t_max: t_far } = inside.hull();
        trace.split(&PacketSplitStep {
            node,
            axis,
            split,
            t_near,
            t_far,
            lanes: inside.lanes(),
            near_lanes,
            far_lanes,
            near_child: near,
            far_child: far,
            stack_depth: self.stack.len(),
        });
        match (near_lanes.is_empty(), far_lanes.is_empty()) {
            (false, _) => Some((near, in_near)),
            (true, false) => Some((far, in_far)),
            (true, true) => None,
        }
    }

    /// Where the lanes are in the near child, and where in the far one.
    fn children(&self, axis: usize, split: f64, inside: &Inside) -> [Inside; 2] {
        let mut children = [Inside([Interval::EMPTY; LANES]); 2];
        for number in inside.lanes().lanes() {
            let parts = self.lanes[number].bound.children(axis, split, inside.0[number]);
            for (child, part) in children.iter_mut().zip(parts) {
                child.0[number] = part;
            }
        }
        children
    }

    fn visit_leaf(&mut self, node: u32, inside: &Inside, trace: &mut impl PacketTrace) {
        let Interval { t_min: t_near, t_max: t_far } = inside.hull();
        let (lanes, stack_depth) = (inside.lanes(), self.stack.len());
        let ids = self.tree.leaf_primitives(node);
        let primitives = ids.len();
        trace.leaf(&PacketLeafStep { node, t_near, t_far, lanes, primitives, stack_depth });
        for &id in ids {
            let unmet = if B::HAS_MAILBOX { self.mailbox.unmet(id, lanes) } else { lanes };
            self.test(id, unmet, trace);
        }
        for number in lanes.lanes() {
            self.lanes[number].measure_reach();
        }
    }

    /// Tests a primitive with the open rays of those lanes that do not miss it as a whole.
    fn test(&mut self, id: u32, lanes: LaneMask, trace: &mut impl PacketTrace) {
        let mut is_set_up = false;
        for number in lanes.lanes() {
            let Lane { bound, rays, .. } = &mut self.lanes[number];
            if bound.misses(self.primitives, id) {
                continue;
            }
            for ray in rays.iter_mut().filter(|ray| !ray.is_done()) {
                if !is_set_up {
                    trace.set_up(id);
                    is_set_up = true;
                }
                let t = ray.test(self.primitives, id, self.query);
                trace.test(id, ray.index, t);
            }
        }
        if !is_set_up && !lanes.is_empty() {
            trace.culled(id);
        }
    }
}

impl<B: Bound> Lane<'_, B> {
    /// The farthest that an open ray reaches ends the search of the lane.
    fn measure_reach(&mut self) {
        let open = self.rays.iter().filter(|ray| !ray.is_done());
        let reaches = open.map(|ray| self.bound.reach(ray.ray()));
        self.reach = reaches.fold(f64::NEG_INFINITY, f64::max);
    }
}
