//! What traversals rely on.

use super::{KdTree, MAX_DEPTH, Node, NodeKind, TreeError};
use crate::geometry::Aabb;
use arrayvec::ArrayVec;

/// The upper children that are still to come, with how many splits lie above each.
type Waiting = ArrayVec<(u32, u32), MAX_DEPTH>;

impl<const K: usize> KdTree<K> {
    /// Checks that every walk through the tree ends, fits its stack and finds what it looks up: nodes in
    /// depth-first order, lists that tile the references, ids below `count`. It takes a fraction of the
    /// time of [`validate`](Self::validate), for it looks at no box and at no primitive.
    ///
    /// # Errors
    /// See [`TreeError`].
    pub(crate) fn check_structure(&self, count: usize) -> Result<(), TreeError> {
        let finite = self.bounds.min.iter().chain(&self.bounds.max).all(|x| x.is_finite());
        if !finite && self.bounds != Aabb::EMPTY {
            return Err(TreeError::BadBounds);
        }
        self.check_order()?;
        let largest = self.references.iter().fold(0, |largest, &id| id.max(largest));
        if self.references.is_empty() || (largest as usize) < count {
            return Ok(());
        }
        let listing = (0..self.nodes.len() as u32)
            .find(|&node| self.leaf_primitives(node).contains(&largest));
        let node = listing.unwrap_or_default();
        Err(TreeError::NoSuchPrimitive { node, primitive: largest, count })
    }

    /// Goes through the nodes as they stand, which is the order that they should have.
    fn check_order(&self) -> Result<(), TreeError> {
        let nodes = self.nodes.len();
        if nodes > Node::MAX_INDEX as usize + 1 {
            let reached = Node::MAX_INDEX as usize + 1;
            return Err(TreeError::UnreachedNodes { reached, nodes });
        }
        let mut waiting = Waiting::new();
        let (mut depth, mut listed) = (0, 0);
        for (index, node) in (0..).zip(self.nodes.iter()) {
            match node.kind() {
                NodeKind::Inner { axis, .. } if axis >= K => {
                    return Err(TreeError::BadAxis { node: index, axis, dimensions: K });
                }
                NodeKind::Inner { above, .. } => {
                    depth += 1;
                    if waiting.try_push((above, depth)).is_err() || depth as usize > MAX_DEPTH {
                        return Err(TreeError::TooDeep { node: index + 1, depth });
                    }
                }
                NodeKind::Leaf { first, count } => {
                    listed = self.check_list(index, first, count, listed)?;
                    let expected = index + 1;
                    match waiting.pop() {
                        Some((above, above_depth)) if above == expected => depth = above_depth,
                        Some((node, _)) => return Err(TreeError::NotDepthFirst { node, expected }),
                        None => return self.check_end(expected as usize, listed as usize),
                    }
                }
            }
        }
        let last = nodes.checked_sub(1).ok_or(TreeError::NoRoot)?;
        Err(TreeError::ChildOutOfRange { node: last as u32, child: nodes as u32, nodes })
    }

    /// Where a leaf's list ends, if it begins behind those before it, which end at `expected`.
    fn check_list(
        &self,
        node: u32,
        first: u32,
        count: u32,
        expected: u32,
    ) -> Result<u32, TreeError> {
        if first != expected {
            return Err(TreeError::ListsDoNotTile { node, first, expected });
        }
        let references = self.references.len();
        let end = first.checked_add(count).filter(|&end| end as usize <= references);
        end.ok_or(TreeError::ListOutOfRange { node, references })
    }

    /// Whether nothing is left behind so many nodes and references.
    fn check_end(&self, reached: usize, listed: usize) -> Result<(), TreeError> {
        let (nodes, references) = (self.nodes.len(), self.references.len());
        if reached < nodes {
            return Err(TreeError::UnreachedNodes { reached, nodes });
        }
        if listed < references {
            return Err(TreeError::UnlistedReferences { listed, references });
        }
        Ok(())
    }
}
