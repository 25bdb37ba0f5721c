//! Which nodes of the binary tree become the children of a wide node.

use super::WideNode;
use crate::geometry::Aabb;
use crate::tree::{KdTree, NodeKind};
use arrayvec::ArrayVec;

/// The upper part of a subtree: its root, cut open until eight nodes are left.
pub(super) struct Treelet<'a> {
    tree: &'a KdTree<3>,
    root: u32,
    /// The nodes that are not cut open and not empty.
    pub(super) ends: ArrayVec<u32, { WideNode::WIDTH }>,
}

impl<'a> Treelet<'a> {
    /// Cuts open, again and again, the inner node that a ray meets most likely: that of the
    /// largest tight box. `boxes` are those of the tree's nodes.
    pub(super) fn new(tree: &'a KdTree<3>, boxes: &[Aabb<3>], root: u32) -> Self {
        let is_inner =
            |node: u32| matches!(tree.nodes()[node as usize].kind(), NodeKind::Inner { .. });
        let mut ends = ArrayVec::new();
        let add = |ends: &mut ArrayVec<u32, 8>, node: u32| {
            if !boxes[node as usize].is_empty() {
                ends.push(node);
            }
        };
        add(&mut ends, root);
        while !ends.is_full() {
            let surface = |&(_, &node): &(usize, &u32)| boxes[node as usize].half_surface();
            let inner = ends.iter().enumerate().filter(|&(_, &node)| is_inner(node));
            let largest = inner.max_by(|a, b| surface(a).total_cmp(&surface(b)));
            let Some((place, &node)) = largest else { break };
            ends.remove(place);
            if let NodeKind::Inner { above, .. } = tree.nodes()[node as usize].kind() {
                add(&mut ends, node + 1);
                add(&mut ends, above);
            }
        }
        Self { tree, root, ends }
    }

    /// The places of the ends, farthest first, for rays whose direction is in `octant`.
    pub(super) fn far_to_near(&self, octant: usize) -> ArrayVec<u8, { WideNode::WIDTH }> {
        let mut places = ArrayVec::new();
        self.visit(self.root, octant, &mut places);
        places
    }

    fn visit(&self, node: u32, octant: usize, places: &mut ArrayVec<u8, { WideNode::WIDTH }>) {
        if let Some(place) = self.ends.iter().position(|&end| end == node) {
            places.push(place as u8);
        } else if let NodeKind::Inner { axis, above, .. } = self.tree.nodes()[node as usize].kind()
        {
            let is_negative = octant >> axis & 1 == 1;
            let [first, then] = if is_negative { [node + 1, above] } else { [above, node + 1] };
            self.visit(first, octant, places);
            self.visit(then, octant, places);
        }
    }
}
