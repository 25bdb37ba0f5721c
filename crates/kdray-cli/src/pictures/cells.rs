//! The boxes of the nodes on a way through the tree.

use kdray::KdTree;
use kdray::tree::{Cell, NodeKind};
use std::collections::HashMap;

/// The cells of the root, and of the children of the inner nodes that were visited: each of these
/// behind its parent.
pub(super) fn cells_on_the_way(
    tree: &KdTree,
    visited: impl IntoIterator<Item = u32>,
) -> HashMap<u32, Cell<3>> {
    let mut cells = HashMap::new();
    cells.insert(0, Cell { node: 0, depth: 0, bounds: *tree.bounds() });
    for node in visited {
        let Some(cell) = cells.get(&node).copied() else { continue };
        if let NodeKind::Inner { axis, split, above } = tree.nodes()[node as usize].kind() {
            let (below_bounds, above_bounds) = cell.bounds.split(axis, split);
            let depth = cell.depth + 1;
            let below = node + 1;
            cells.insert(below, Cell { node: below, depth, bounds: below_bounds });
            cells.insert(above, Cell { node: above, depth, bounds: above_bounds });
        }
    }
    cells
}
