//! Which nodes of the binary tree become the children of a wide node.

use super::WideNode;
use super::collapse::Collapse;
use crate::geometry::Aabb;
use crate::tree::{KdTree, NodeKind};
use arrayvec::ArrayVec;

/// Places of children in a wide node.
type Places = ArrayVec<u8, { WideNode::WIDTH }>;

/// The upper part of a subtree: its root, cut open until up to eight nodes are left.
#[derive(Default)]
pub(super) struct Treelet {
    /// The nodes that are not cut open and not empty, from the lowest on.
    pub(super) ends: ArrayVec<u32, { WideNode::WIDTH }>,
    /// What was cut open, parents before their children.
    cuts: ArrayVec<Cut, { WideNode::WIDTH }>,
}

/// A node that was cut open; neither child is empty.
struct Cut {
    node: u32,
    axis: usize,
    split: f32,
    lower: u32,
    upper: u32,
}

impl Treelet {
    pub(super) fn new(collapse: &Collapse<'_>, root: u32) -> Self {
        let mut treelet = Self::default();
        if let Some(root) = filled(collapse.tree, collapse.boxes, root) {
            treelet.add(collapse, root, WideNode::WIDTH);
        }
        treelet
    }

    /// Adds a node that is not empty in so many places.
    fn add(&mut self, collapse: &Collapse<'_>, node: u32, places: usize) {
        let Collapse { tree, boxes, .. } = collapse;
        if let NodeKind::Inner { axis, split, above } = tree.nodes()[node as usize].kind()
            && let share @ 1.. = collapse.share(node, places)
            && let Some(lower) = filled(tree, boxes, node + 1)
            && let Some(upper) = filled(tree, boxes, above)
        {
            self.cuts.push(Cut { node, axis, split, lower, upper });
            self.add(collapse, lower, share);
            self.add(collapse, upper, places - share);
        } else {
            self.ends.push(node);
        }
    }

    /// Says that a node is cut open; neither child is empty.
    pub(super) fn push_cut(&mut self, node: u32, axis: usize, split: f32, lower: u32, upper: u32) {
        self.cuts.push(Cut { node, axis, split, lower, upper });
    }

    /// The cell of an end, with the empty ones beside it that nothing is in; `cell` is the treelet's.
    pub(super) fn cell(&self, end: u32, mut cell: Aabb<3>) -> Aabb<3> {
        let mut at = self.cuts.first().map(|cut| cut.node);
        for cut in &self.cuts {
            if at != Some(cut.node) {
                continue;
            }
            // All nodes below the upper child come behind it, all below the lower one before it.
            let is_above = end >= cut.upper;
            let (below, above) = cell.split(cut.axis, cut.split);
            cell = if is_above { above } else { below };
            at = Some(if is_above { cut.upper } else { cut.lower });
        }
        cell
    }

    /// The places of the ends, farthest first, for rays whose direction is in `octant`.
    pub(super) fn far_to_near(&self, octant: usize) -> Places {
        let root = self.cuts.first().map(|cut| cut.node).or(self.ends.first().copied());
        let mut waiting = ArrayVec::<u32, { WideNode::WIDTH }>::from_iter(root);
        let mut places = Places::new();
        while let Some(node) = waiting.pop() {
            match self.cuts.iter().find(|cut| cut.node == node) {
                Some(cut) if octant >> cut.axis & 1 == 1 => waiting.extend([cut.upper, cut.lower]),
                Some(cut) => waiting.extend([cut.lower, cut.upper]),
                None => {
                    let place = self.ends.iter().position(|&end| end == node);
                    places.extend(place.map(|place| place as u8));
                }
            }
        }
        places
    }
}

/// The node itself, or the uppermost one below it that holds the same and has no empty child; `None`
/// if it is empty.
pub(super) fn filled(tree: &KdTree<3>, boxes: &[Aabb<3>], mut node: u32) -> Option<u32> {
    if boxes[node as usize].is_empty() {
        return None;
    }
    while let NodeKind::Inner { above, .. } = tree.nodes()[node as usize].kind() {
        let lower = node + 1;
        match [lower, above].map(|child| boxes[child as usize].is_empty()) {
            [false, false] => break,
            [lower_is_empty, _] => node = if lower_is_empty { above } else { lower },
        }
    }
    Some(node)
}
