//! The tight boxes of a tree's cells.

use crate::geometry::Aabb;
use crate::tree::{KdTree, NodeKind};

/// For each node of a tree the bounds of what lies in its cell, empty where nothing does. `parts`
/// are those of each reference: of the part of its primitive that lies in the leaf.
pub(super) fn tight_boxes(tree: &KdTree<3>, parts: &[Aabb<3>]) -> Vec<Aabb<3>> {
    let mut boxes = vec![Aabb::EMPTY; tree.nodes().len()];
    // Children stand behind their parents.
    for (index, node) in tree.nodes().iter().enumerate().rev() {
        boxes[index] = match node.kind() {
            NodeKind::Inner { above, .. } => boxes[index + 1].union(&boxes[above as usize]),
            NodeKind::Leaf { first, count } => {
                let parts = &parts[first as usize..(first + count) as usize];
                parts.iter().fold(Aabb::EMPTY, |bounds, part| bounds.union(part))
            }
        };
    }
    boxes
}
