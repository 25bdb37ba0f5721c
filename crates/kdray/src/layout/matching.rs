//! Which part of the canonical tree each part of a wide one is.

use super::arena::Arena;
use super::home::Home;
use super::treelet::Treelet;
use super::{Link, WideTree};
use crate::geometry::Aabb;
use crate::tree::{KdTree, NodeKind};

/// A wide tree beside its canonical one. Both list the same triangles in the same order, so that their
/// numbers tell which nodes belong together.
pub(super) struct Matching<'a> {
    wide: &'a WideTree,
    tree: &'a KdTree<3>,
    /// For each node of the canonical tree how many references there are below it.
    references: Vec<u32>,
    /// For each wide node how many triangles there are below it.
    triangles: Vec<u32>,
}

/// The children of a wide node as parts of the canonical tree.
#[derive(Default)]
pub(super) struct Parts {
    pub(super) treelet: Treelet,
    /// The true cells of the treelet's ends.
    pub(super) cells: Vec<Aabb<3>>,
}

impl<'a> Matching<'a> {
    pub(super) fn new(wide: &'a WideTree, tree: &'a KdTree<3>) -> Self {
        let references = references_below(tree);
        let triangles = triangles_below(&wide.arena, wide.homes.list());
        Self { wide, tree, references, triangles }
    }

    /// Which parts of a node of the canonical tree, whose true cell is `cell`, the children of the wide
    /// node at `link` are; `None` if they are none.
    pub(super) fn parts(&self, link: Link, node: u32, cell: Aabb<3>) -> Option<Parts> {
        let wide = self.wide.node(link);
        let links = &wide.links()[..wide.child_count()];
        let weights: Vec<u32> = links.iter().map(|&bits| self.weight(bits)).collect();
        let mut parts = Parts::default();
        if self.references[node as usize] == 0 {
            return weights.is_empty().then_some(parts);
        }
        self.cut(&mut parts, node, cell, &weights)?;
        Some(parts)
    }

    /// How many triangles there are below a link.
    fn weight(&self, bits: u32) -> u32 {
        let link = Link::from_bits(bits);
        if link.is_leaf() {
            return triangles_in(&self.wide.arena, link);
        }
        self.triangles.get(self.wide.homes.number_at(link) as usize).copied().unwrap_or(0)
    }

    /// Cuts a node open, so that there are parts of as many references as the weights say.
    fn cut(&self, parts: &mut Parts, node: u32, cell: Aabb<3>, weights: &[u32]) -> Option<()> {
        let (node, cell) = self.filled(node, cell);
        if let [weight] = weights {
            parts.treelet.ends.push(node);
            parts.cells.push(cell);
            return (self.references[node as usize] == *weight).then_some(());
        }
        let NodeKind::Inner { axis, split, above } = self.tree.nodes()[node as usize].kind() else {
            return None;
        };
        let below = self.references[node as usize + 1];
        let count = first_of_sum(weights, below)?;
        let (lower, upper) = cell.split(axis, split);
        let (lower_node, _) = self.filled(node + 1, lower);
        let (upper_node, _) = self.filled(above, upper);
        parts.treelet.push_cut(node, axis, split, lower_node, upper_node);
        self.cut(parts, node + 1, lower, &weights[..count])?;
        self.cut(parts, above, upper, &weights[count..])
    }

    /// The node itself, or the uppermost below it that holds the same and has no empty child; with its
    /// cell. It holds something.
    fn filled(&self, mut node: u32, mut cell: Aabb<3>) -> (u32, Aabb<3>) {
        while let NodeKind::Inner { axis, split, above } = self.tree.nodes()[node as usize].kind() {
            let (lower, upper) = cell.split(axis, split);
            match [node + 1, above].map(|child| self.references[child as usize] == 0) {
                [false, false] => break,
                [true, _] => (node, cell) = (above, upper),
                [false, true] => (node, cell) = (node + 1, lower),
            }
        }
        (node, cell)
    }
}

/// For each node how many references there are below it.
fn references_below(tree: &KdTree<3>) -> Vec<u32> {
    let mut below = vec![0; tree.nodes().len()];
    // Children stand behind their parents.
    for (index, node) in tree.nodes().iter().enumerate().rev() {
        below[index] = match node.kind() {
            NodeKind::Inner { above, .. } => below[index + 1] + below[above as usize],
            NodeKind::Leaf { count, .. } => count,
        };
    }
    below
}

/// For each home how many triangles there are below its node.
fn triangles_below(arena: &Arena, homes: &[Home]) -> Vec<u32> {
    let mut below = vec![0; homes.len()];
    for (number, home) in homes.iter().enumerate().rev() {
        let links = arena.node(home.link()).links().map(Link::from_bits);
        let leaves = links.into_iter().filter(|link| link.is_leaf());
        below[number] += leaves.map(|link| triangles_in(arena, link)).sum::<u32>();
        if number > 0 {
            below[home.parent() as usize] += below[number];
        }
    }
    below
}

fn triangles_in(arena: &Arena, leaf: Link) -> u32 {
    (0..leaf.block_count()).map(|index| arena.block(leaf, index).triangle_count()).sum()
}

/// How many of the first weights make up a sum; none of it and all of it do not count.
fn first_of_sum(weights: &[u32], sum: u32) -> Option<usize> {
    let mut found = 0;
    let reaches = |&weight: &u32| {
        found += weight;
        found >= sum
    };
    let count = weights.iter().position(reaches)? + 1;
    (found == sum && count < weights.len()).then_some(count)
}
