//! The nodes and lists of a part of the tree, as they are built.

use super::BuildError;
use super::reference::{Reference, merge_parts};
use crate::geometry::Aabb;
use crate::tree::{CostModel, Node, NodeKind};

/// Nodes in depth-first order and the lists of their leaves, numbered from zero.
pub(super) struct Subtree<const K: usize> {
    pub(super) nodes: Vec<Node>,
    pub(super) references: Vec<u32>,
    /// The bounds of each reference's part in its leaf, if they are kept.
    pub(super) bounds: Vec<Aabb<K>>,
    keeps_bounds: bool,
}

/// Where an inner node stands whose children are being built, and where their lists begin.
#[derive(Clone, Copy)]
pub(super) struct Place {
    node: usize,
    reference: usize,
}

impl<const K: usize> Subtree<K> {
    pub(super) fn new(keeps_bounds: bool) -> Self {
        let (nodes, references, bounds) = (Vec::new(), Vec::new(), Vec::new());
        Self { nodes, references, bounds, keeps_bounds }
    }

    /// Adds a leaf.
    pub(super) fn push_leaf(&mut self, references: &[Reference<K>]) {
        self.nodes.push(Node::leaf(self.references.len() as u32, references.len() as u32));
        self.references.extend(references.iter().map(|reference| reference.id));
        if self.keeps_bounds {
            self.bounds.extend(references.iter().map(|reference| reference.bounds));
        }
    }

    /// Keeps the place of an inner node, until its children are there.
    pub(super) fn reserve_inner(&mut self) -> Place {
        self.nodes.push(Node::leaf(0, 0));
        Place { node: self.nodes.len() - 1, reference: self.references.len() }
    }

    /// Makes the node at `place` one whose upper child comes next.
    pub(super) fn close_lower(
        &mut self,
        place: Place,
        axis: usize,
        split: f32,
    ) -> Result<(), BuildError> {
        let above = u32::try_from(self.nodes.len()).unwrap_or(u32::MAX);
        if above > Node::MAX_INDEX {
            return Err(BuildError::TooManyNodes);
        }
        self.nodes[place.node] = Node::inner(axis, split, above);
        Ok(())
    }

    /// Makes a leaf of the node at `place` and all below it, which end this subtree. It lists what
    /// they listed, each primitive once, by rising id.
    pub(super) fn make_leaf(&mut self, place: Place) {
        self.nodes.truncate(place.node);
        if self.keeps_bounds {
            let ids = self.references.drain(place.reference..);
            let parts = ids.zip(self.bounds.drain(place.reference..));
            let mut parts: Vec<_> = parts.map(|(id, bounds)| Reference { id, bounds }).collect();
            merge_parts(&mut parts, 0);
            return self.push_leaf(&parts);
        }
        self.references[place.reference..].sort_unstable();
        let mut end = place.reference;
        for next in place.reference..self.references.len() {
            let id = self.references[next];
            if end == place.reference || self.references[end - 1] != id {
                self.references[end] = id;
                end += 1;
            }
        }
        self.references.truncate(end);
        let count = end - place.reference;
        self.nodes.push(Node::leaf(place.reference as u32, count as u32));
    }

    /// Adds a subtree that was built apart behind this one.
    pub(super) fn append(&mut self, other: &Self) -> Result<(), BuildError> {
        let (nodes, references) = (self.nodes.len() as u32, self.references.len() as u32);
        if self.nodes.len() + other.nodes.len() > Node::MAX_INDEX as usize {
            return Err(BuildError::TooManyNodes);
        }
        self.nodes.extend(other.nodes.iter().map(|node| match node.kind() {
            NodeKind::Inner { axis, split, above } => Node::inner(axis, split, above + nodes),
            NodeKind::Leaf { first, count } => Node::leaf(first + references, count),
        }));
        self.references.extend_from_slice(&other.references);
        self.bounds.extend_from_slice(&other.bounds);
        Ok(())
    }
}

/// What a subtree is expected to cost the lines that meet the root, times the root's surface; and
/// the box around all that it lists, by whose surface that is reckoned.
#[derive(Clone, Copy)]
pub(super) struct Expected<const K: usize> {
    pub(super) cost: f64,
    tight: Aabb<K>,
}

impl<const K: usize> Expected<K> {
    /// That of a leaf.
    pub(super) fn of_leaf(cost: &CostModel, references: &[Reference<K>]) -> Self {
        let tight = references.iter().fold(Aabb::EMPTY, |tight, r| tight.union(&r.bounds));
        Self { cost: surface(&tight) * cost.leaf(references.len()), tight }
    }

    /// That of a node with two children.
    pub(super) fn of_inner(cost: &CostModel, lower: &Self, upper: &Self) -> Self {
        let tight = lower.tight.union(&upper.tight);
        Self { cost: surface(&tight) * cost.traversal + lower.cost + upper.cost, tight }
    }

    /// That of the same as one leaf of `count` references.
    pub(super) fn if_leaf(&self, cost: &CostModel, count: usize) -> Self {
        Self { cost: surface(&self.tight) * cost.leaf(count), tight: self.tight }
    }
}

fn surface<const K: usize>(tight: &Aabb<K>) -> f64 {
    if tight.is_empty() { 0.0 } else { tight.half_surface() }
}
