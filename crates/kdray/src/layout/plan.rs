//! How much room the parts of a wide tree take, before any of them is placed.

use super::arena::Link;
use super::collapse::Collapse;
use super::size::Size;
use super::treelet::Treelet;
use super::{TriangleBlock, WideNode};
use crate::build::parallel::map_all;
use crate::tree::{KdTree, NodeKind};

/// Most triangles that one link leads to.
const MOST: usize = Link::MOST_BLOCKS * TriangleBlock::WIDTH;

/// The room of a subtree, so that its parts can be placed at once, each where it would stand if they
/// were placed one after the other.
pub(super) struct Plan {
    /// That of its nodes and blocks.
    pub(super) size: Size,
    /// The plans of those children that are nodes, in order; none if all of it is placed in one go.
    pub(super) children: Vec<Plan>,
}

/// How many levels of wide nodes are worked at one by one, so that threads share what is below: enough for some hundred
/// parts; none of a tree of few nodes, which stays on one thread.
pub(super) fn levels_apart(tree: &KdTree<3>) -> usize {
    const LEVELS: usize = 3;
    const LARGE: usize = 1 << 12;
    if tree.nodes().len() < LARGE { 0 } else { LEVELS }
}

impl Plan {
    /// That of the whole tree.
    pub(super) fn new(collapse: &Collapse<'_>) -> Self {
        Self::of_node(collapse, 0, levels_apart(collapse.tree))
    }

    fn of_node(collapse: &Collapse<'_>, node: u32, levels: usize) -> Self {
        if levels == 0 {
            return Self { size: size_of_node(collapse, node), children: Vec::new() };
        }
        let mut size = Size::NODE;
        let mut inner = Vec::new();
        for &end in &Treelet::new(collapse, node).ends {
            match collapse.tree.nodes()[end as usize].kind() {
                NodeKind::Leaf { count, .. } => size = size + size_of_leaf(count as usize),
                NodeKind::Inner { .. } => inner.push(end),
            }
        }
        let children = map_all(inner, |end| Self::of_node(collapse, end, levels - 1));
        let below: Size = children.iter().map(|child| child.size).sum();
        Self { size: size + below, children }
    }
}

fn size_of_node(collapse: &Collapse<'_>, node: u32) -> Size {
    let ends = Treelet::new(collapse, node).ends;
    let below = ends.iter().map(|&end| match collapse.tree.nodes()[end as usize].kind() {
        NodeKind::Leaf { count, .. } => size_of_leaf(count as usize),
        NodeKind::Inner { .. } => size_of_node(collapse, end),
    });
    Size::NODE + below.sum()
}

/// The size of a leaf of `count` triangles, and of the nodes above them if there are too many for
/// one link.
fn size_of_leaf(count: usize) -> Size {
    let Some(part) = part_of_leaf(count) else {
        return Size::of_blocks(count.div_ceil(TriangleBlock::WIDTH));
    };
    let rest = count % part;
    let rest = if rest == 0 { Size::default() } else { size_of_leaf(rest) };
    Size::NODE + count / part * size_of_leaf(part) + rest
}

/// How many triangles each child of a node gets, if `count` are too many for one link.
pub(super) fn part_of_leaf(count: usize) -> Option<usize> {
    (count > MOST).then(|| count.div_ceil(MOST).div_ceil(WideNode::WIDTH) * MOST)
}
