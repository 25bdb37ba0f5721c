//! The tight boxes of a tree's cells.

use crate::geometry::Aabb;
use crate::primitives::Primitives;
use crate::tree::{KdTree, NodeKind};

/// For each node of a tree the bounds of what lies in its cell: of the parts of its primitives, not
/// of the cell. Empty where nothing does.
pub(super) fn tight_boxes(tree: &KdTree<3>, primitives: &impl Primitives<3>) -> Vec<Aabb<3>> {
    let mut boxes = vec![Aabb::EMPTY; tree.nodes().len()];
    for cell in tree.cells() {
        boxes[cell.node as usize] = tree
            .leaf_primitives(cell.node)
            .iter()
            .filter_map(|&id| primitives.clipped_bounds(id, &cell.bounds))
            .fold(Aabb::EMPTY, |bounds, part| bounds.union(&part));
    }
    // Children stand behind their parents.
    for index in (0..boxes.len()).rev() {
        if let NodeKind::Inner { above, .. } = tree.nodes()[index].kind() {
            boxes[index] = boxes[index + 1].union(&boxes[above as usize]);
        }
    }
    boxes
}
