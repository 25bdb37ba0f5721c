//! The canonical kd-tree, from which everything else is derived.

mod content;
mod cost;
mod error;
mod node;
mod stats;
mod structure;
mod validate;

pub use cost::{CostModel, CostModelError, Termination};
pub use error::TreeError;
pub use node::{Node, NodeKind};
pub use stats::TreeStats;

use crate::geometry::Aabb;
use crate::memory::Store;

/// No tree is deeper than this; traversal stacks hold as many entries.
pub const MAX_DEPTH: usize = 64;

/// A kd-tree (S5): nested boxes, each cut in two by a plane perpendicular to an axis.
///
/// Node 0 is the root; nodes stand in depth-first order, a node's lower child right behind it. The
/// box of a node is implied by the splits above it. Leaves list the ids of primitives.
#[derive(Clone, Debug, PartialEq)]
pub struct KdTree<const K: usize = 3> {
    pub(crate) bounds: Aabb<K>,
    pub(crate) nodes: Store<Node>,
    pub(crate) references: Store<u32>,
}

/// A node with the box that it stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell<const K: usize> {
    /// The node's index.
    pub node: u32,
    /// How many splits lie above it.
    pub depth: u32,
    /// Its box.
    pub bounds: Aabb<K>,
}

impl<const K: usize> KdTree<K> {
    /// The box around all primitives; empty if there are none.
    pub fn bounds(&self) -> &Aabb<K> {
        &self.bounds
    }

    /// All nodes, the root first, in depth-first order.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The primitives that a leaf lists; nothing for an inner node.
    ///
    /// # Panics
    /// If there is no node of that number.
    pub fn leaf_primitives(&self, node: u32) -> &[u32] {
        match self.nodes[node as usize].kind() {
            NodeKind::Leaf { first, count } => {
                &self.references[first as usize..(first + count) as usize]
            }
            NodeKind::Inner { .. } => &[],
        }
    }

    /// All nodes with their boxes, in depth-first order.
    pub fn cells(&self) -> impl Iterator<Item = Cell<K>> + '_ {
        let mut stack = vec![Cell { node: 0, depth: 0, bounds: self.bounds }];
        std::iter::from_fn(move || {
            let cell = stack.pop()?;
            if let NodeKind::Inner { axis, split, above } = self.nodes[cell.node as usize].kind() {
                let depth = cell.depth + 1;
                let (lower, upper) = cell.bounds.split(axis, split);
                stack.push(Cell { node: above, depth, bounds: upper });
                stack.push(Cell { node: cell.node + 1, depth, bounds: lower });
            }
            Some(cell)
        })
    }
}
