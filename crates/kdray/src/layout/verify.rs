//! Whether a wide tree is one of its canonical tree and mesh.
//!
//! Nearly all of it follows from those two, and is compared bit by bit: the triangles of blocks, the
//! order of children, homes. Two things do not: how the tree is collapsed, which is a matter of speed,
//! and what rounding did to the boxes. Any collapse is accepted, and any box that holds what it must.

use super::arena::{Arena, BLOCK_LINES};
use super::home::{Home, Site};
use super::homes::Homes;
use super::plan::part_of_leaf;
use super::treelet::Treelet;
use super::wide::{FULL_MARGIN, margin};
use super::{Link, TriangleBlock, WideError, WideNode, WideTree};
use crate::build::parallel::map_all;
use crate::geometry::Aabb;
use crate::primitives::{Primitives, TriangleMesh};
use crate::tree::{KdTree, NodeKind};
use bytemuck::bytes_of;

/// By how much, in units of u R, boxes must be larger than what is in them: the error of the slab test
/// (`docs/decisions/0008`). They are made two units larger, because the same part of a triangle clipped
/// once more may come out larger by the last place of a coordinate.
const LEAST_MARGIN: f32 = 10.0;

/// How many levels of wide nodes are verified on several threads: enough for some hundred parts.
const LEVELS: usize = 3;

struct Verifier<'a> {
    wide: &'a WideTree,
    tree: &'a KdTree<3>,
    mesh: &'a TriangleMesh,
    /// For each node of the canonical tree how many references there are below it.
    references: Vec<u32>,
    /// For each wide node how many triangles there are below it.
    triangles: Vec<u32>,
}

/// What a child of a wide node stands for.
#[derive(Clone, Copy)]
struct Stand {
    /// The node of the canonical tree.
    node: u32,
    /// The true cell of that node.
    cell: Aabb<3>,
    site: Site,
    /// The child's box.
    bounds: Aabb<3>,
}

/// The children of a wide node as parts of the canonical tree.
#[derive(Default)]
struct Parts {
    treelet: Treelet,
    /// The true cells of the treelet's ends.
    cells: Vec<Aabb<3>>,
}

impl WideTree {
    /// Checks a wide tree, whose structure is known to be right, against the canonical tree, which is
    /// known to be valid.
    pub(crate) fn verify(&self, tree: &KdTree<3>, mesh: &TriangleMesh) -> Result<(), WideError> {
        let verifier = Verifier {
            wide: self,
            tree,
            mesh,
            references: references_below(tree),
            triangles: triangles_below(&self.arena, self.homes.list()),
        };
        verifier.verify()
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

impl Verifier<'_> {
    fn verify(&self) -> Result<(), WideError> {
        let root = Aabb { min: [f32::NEG_INFINITY; 3], max: [f32::INFINITY; 3] };
        let stand = Stand { node: 0, cell: *self.tree.bounds(), site: Site::ROOT, bounds: root };
        self.verify_node(Link::ROOT, &stand, LEVELS)?;
        let homes = &self.wide.homes;
        let above = Homes::above_each_slot(homes.list(), &self.wide.arena);
        if above == **homes.numbers_above() { Ok(()) } else { Err(WideError::WrongNodeAbove) }
    }

    /// Verifies a wide node and all below it, on several threads for so many levels.
    fn verify_node(&self, link: Link, stand: &Stand, levels: usize) -> Result<(), WideError> {
        let node = self.wide.node(link);
        let number = self.verify_home(link, &stand.site)?;
        let parts = self.parts(link, stand)?;
        let wrong = WideError::NotTheTrees { line: link.line() };
        if (0..8).any(|octant| node.order(octant) != order(&parts.treelet, octant)) {
            return Err(wrong);
        }
        let verify_child = |(place, cell): (usize, Aabb<3>)| {
            let bounds = self.child_box(link, place, &stand.bounds)?;
            let end = parts.treelet.ends[place];
            let cell_beside = parts.treelet.cell(end, stand.site.cell);
            let site = Site { cell: cell_beside, parent: number, place };
            let child = Link::from_bits(node.links()[place]);
            let child_stand = Stand { node: end, cell, site, bounds };
            match self.tree.nodes()[end as usize].kind() {
                NodeKind::Leaf { .. } => {
                    let ids = self.tree.leaf_primitives(end);
                    self.verify_leaf(child, ids, &child_stand, link)
                }
                // One with a single child would stand for the same node once more.
                NodeKind::Inner { .. } if child.is_leaf() || parts.cells.len() == 1 => Err(wrong),
                NodeKind::Inner { .. } => {
                    self.verify_node(child, &child_stand, levels.saturating_sub(1))
                }
            }
        };
        let mut children = parts.cells.iter().copied().enumerate();
        if levels == 0 {
            return children.try_for_each(verify_child);
        }
        map_all(children.collect(), verify_child).into_iter().collect()
    }

    /// The number of the node's home, if that is the right one.
    fn verify_home(&self, link: Link, site: &Site) -> Result<u32, WideError> {
        let number = self.number(link);
        let expected = Home::new(site, link, margin(FULL_MARGIN, self.wide.reach));
        let found = self.wide.homes.list().get(number as usize);
        let is_right = found.is_some_and(|home| bytes_of(home) == bytes_of(&expected));
        if is_right { Ok(number) } else { Err(WideError::BadHome { line: link.line() }) }
    }

    /// Homes stand in the order of their nodes' lines.
    fn number(&self, link: Link) -> u32 {
        self.wide.homes.list().partition_point(|home| home.link().line() < link.line()) as u32
    }

    /// The box of a child, if it lies in that of the node.
    fn child_box(&self, link: Link, place: usize, of: &Aabb<3>) -> Result<Aabb<3>, WideError> {
        let bounds = self.wide.node(link).child_box(place);
        if bounds.union(of) == *of {
            Ok(bounds)
        } else {
            Err(WideError::BoxTooSmall { line: link.line() })
        }
    }

    /// Verifies the leaf, or the node above several leaves, at `link`, which is a child of the node at
    /// `above` and should list `ids`.
    fn verify_leaf(
        &self,
        link: Link,
        ids: &[u32],
        stand: &Stand,
        above: Link,
    ) -> Result<(), WideError> {
        if let Some(part) = part_of_leaf(ids.len()) {
            return self.verify_parts_of_leaf(link, ids.chunks(part), stand, above);
        }
        if !link.is_leaf() || link.block_count() != ids.len().div_ceil(TriangleBlock::WIDTH) {
            return Err(WideError::NotTheTrees { line: above.line() });
        }
        for (index, ids) in ids.chunks(TriangleBlock::WIDTH).enumerate() {
            let triangles = ids.iter().map(|&id| (id, self.mesh.corners(id)));
            let expected = TriangleBlock::new(triangles);
            let block = self.wide.block(link, index);
            if bytes_of(block) != bytes_of(&expected) {
                let line = link.line() + index * BLOCK_LINES;
                return Err(WideError::NotTheLeafs { line });
            }
        }
        let least = margin(LEAST_MARGIN, self.wide.reach);
        let fits = |&id: &u32| match self.mesh.clipped_bounds(id, &stand.cell) {
            Some(part) => holds(&stand.bounds, &part, least),
            None => true,
        };
        let fit = ids.iter().all(fits);
        if fit { Ok(()) } else { Err(WideError::BoxTooSmall { line: above.line() }) }
    }

    /// Verifies a node over the parts of a leaf that is too large for one link.
    fn verify_parts_of_leaf<'a>(
        &self,
        link: Link,
        parts: impl ExactSizeIterator<Item = &'a [u32]>,
        stand: &Stand,
        above: Link,
    ) -> Result<(), WideError> {
        let wrong = WideError::NotTheTrees { line: above.line() };
        if link.is_leaf() {
            return Err(wrong);
        }
        let node = self.wide.node(link);
        if node.child_count() != parts.len() {
            return Err(wrong);
        }
        let number = self.verify_home(link, &stand.site)?;
        for (place, ids) in parts.enumerate() {
            let bounds = self.child_box(link, place, &stand.bounds)?;
            let site = Site { cell: stand.site.cell, parent: number, place };
            let child = Link::from_bits(node.links()[place]);
            let part = Stand { site, bounds, ..*stand };
            self.verify_leaf(child, ids, &part, link)?;
        }
        Ok(())
    }

    /// Which parts of the canonical tree the children of a node are.
    fn parts(&self, link: Link, stand: &Stand) -> Result<Parts, WideError> {
        let node = self.wide.node(link);
        let count = node.child_count();
        let weights: Vec<u32> =
            node.links()[..count].iter().map(|&bits| self.weight(bits)).collect();
        let mut parts = Parts::default();
        let line = link.line();
        if self.references[stand.node as usize] == 0 {
            return if count == 0 { Ok(parts) } else { Err(WideError::NotTheTrees { line }) };
        }
        let found = self.cut(&mut parts, stand.node, stand.cell, &weights);
        found.map(|()| parts).ok_or(WideError::NotTheTrees { line })
    }

    /// How many triangles there are below a link.
    fn weight(&self, bits: u32) -> u32 {
        let link = Link::from_bits(bits);
        if link.is_leaf() {
            return triangles_in(&self.wide.arena, link);
        }
        self.triangles.get(self.number(link) as usize).copied().unwrap_or(0)
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

/// The order of a treelet's ends in an octant.
fn order(treelet: &Treelet, octant: usize) -> u32 {
    let mut node = WideNode::EMPTY;
    node.set_order(octant, &treelet.far_to_near(octant));
    node.order(octant)
}

/// Whether a box holds another, and a margin around it.
fn holds(outer: &Aabb<3>, inner: &Aabb<3>, margin: f64) -> bool {
    (0..3).all(|axis| {
        f64::from(outer.min[axis]) <= f64::from(inner.min[axis]) - margin
            && f64::from(outer.max[axis]) >= f64::from(inner.max[axis]) + margin
    })
}
