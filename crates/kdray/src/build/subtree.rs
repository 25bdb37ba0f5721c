//! The nodes and lists of a part of the tree, as they are built.

use super::BuildError;
use super::reference::Reference;
use crate::tree::{Node, NodeKind};

/// Nodes in depth-first order and the lists of their leaves, numbered from zero.
#[derive(Default)]
pub(super) struct Subtree {
    pub(super) nodes: Vec<Node>,
    pub(super) references: Vec<u32>,
}

impl Subtree {
    /// Adds a leaf.
    pub(super) fn push_leaf<const K: usize>(&mut self, references: &[Reference<K>]) {
        self.nodes.push(Node::leaf(self.references.len() as u32, references.len() as u32));
        self.references.extend(references.iter().map(|reference| reference.id));
    }

    /// Keeps the place of an inner node, until its children are there.
    pub(super) fn reserve_inner(&mut self) -> usize {
        self.nodes.push(Node::leaf(0, 0));
        self.nodes.len() - 1
    }

    /// Makes the node at `index` one whose upper child comes next.
    pub(super) fn close_lower(
        &mut self,
        index: usize,
        axis: usize,
        split: f32,
    ) -> Result<(), BuildError> {
        let above = u32::try_from(self.nodes.len()).unwrap_or(u32::MAX);
        if above > Node::MAX_INDEX {
            return Err(BuildError::TooManyNodes);
        }
        self.nodes[index] = Node::inner(axis, split, above);
        Ok(())
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
        Ok(())
    }
}
