//! How much room the parts of a wide tree take, before any of them is placed.

use super::arena::{Link, NODE_LINES, leaf_lines};
use super::collapse::Collapse;
use super::treelet::Treelet;
use super::{TriangleBlock, WideNode};
use crate::build::parallel::map_all;
use crate::tree::NodeKind;

/// Most triangles that one link leads to.
const MOST: usize = Link::MOST_BLOCKS * TriangleBlock::WIDTH;

/// The room of a subtree, so that its parts can be placed at once, each where it would stand if they
/// were placed one after the other.
pub(super) struct Plan {
    /// The lines of its nodes and blocks.
    pub(super) lines: usize,
    /// The plans of those children that are nodes, in order; none if all of it is placed in one go.
    pub(super) children: Vec<Plan>,
}

/// How many levels of wide nodes are planned one by one: enough for some hundred parts.
const LEVELS: usize = 3;

/// Trees with fewer nodes are placed in one go.
const LARGE: usize = 1 << 12;

impl Plan {
    /// That of the whole tree.
    pub(super) fn new(collapse: &Collapse<'_>) -> Self {
        let levels = if collapse.tree.nodes().len() < LARGE { 0 } else { LEVELS };
        Self::of_node(collapse, 0, levels)
    }

    fn of_node(collapse: &Collapse<'_>, node: u32, levels: usize) -> Self {
        if levels == 0 {
            return Self { lines: lines_of_node(collapse, node), children: Vec::new() };
        }
        let mut lines = NODE_LINES;
        let mut inner = Vec::new();
        for &end in &Treelet::new(collapse, node).ends {
            match collapse.tree.nodes()[end as usize].kind() {
                NodeKind::Leaf { count, .. } => lines += lines_of_leaf(count as usize),
                NodeKind::Inner { .. } => inner.push(end),
            }
        }
        let children = map_all(inner, |end| Self::of_node(collapse, end, levels - 1));
        lines += children.iter().map(|child| child.lines).sum::<usize>();
        Self { lines, children }
    }
}

fn lines_of_node(collapse: &Collapse<'_>, node: u32) -> usize {
    let ends = Treelet::new(collapse, node).ends;
    let below = ends.iter().map(|&end| match collapse.tree.nodes()[end as usize].kind() {
        NodeKind::Leaf { count, .. } => lines_of_leaf(count as usize),
        NodeKind::Inner { .. } => lines_of_node(collapse, end),
    });
    NODE_LINES + below.sum::<usize>()
}

/// The lines of a leaf of `count` triangles, and of the nodes above them if there are too many for
/// one link.
fn lines_of_leaf(count: usize) -> usize {
    let Some(part) = part_of_leaf(count) else {
        return leaf_lines(count.div_ceil(TriangleBlock::WIDTH));
    };
    let rest = count % part;
    let rest = if rest == 0 { 0 } else { lines_of_leaf(rest) };
    NODE_LINES + count / part * lines_of_leaf(part) + rest
}

/// How many triangles each child of a node gets, if `count` are too many for one link.
pub(super) fn part_of_leaf(count: usize) -> Option<usize> {
    (count > MOST).then(|| count.div_ceil(MOST).div_ceil(WideNode::WIDTH) * MOST)
}
