//! Whether a wide tree is one of its canonical tree and mesh.
//!
//! Nearly all of it follows from those two, and is compared bit by bit: the triangles of blocks, the
//! order of children, homes. Two things do not: how the tree is collapsed, which is a matter of speed,
//! and what rounding did to the boxes. Any collapse is accepted, and any box that holds what it must.

use super::arena::BLOCK_LINES;
use super::home::{Home, Site};
use super::homes::Homes;
use super::matching::Matching;
use super::plan::{levels_apart, part_of_leaf};
use super::treelet::Treelet;
use super::wide::{FULL_MARGIN, margin};
use super::{Link, TriangleBlock, WideError, WideNode, WideTree};
use crate::build::parallel::map_all;
use crate::geometry::{Aabb, Coordinate};
use crate::primitives::TriangleMesh;
use crate::tree::{KdTree, NodeKind};
use bytemuck::bytes_of;

/// By how much, in units of u R, boxes must be larger than what is in them: the error of the slab test
/// (`docs/decisions/0008`). They are made two units larger, because the same part of a triangle clipped
/// once more may come out larger by the last place of a coordinate. More than that, where a triangle is cut at a
/// sharp angle, `inner_bounds` sees to.
const LEAST_MARGIN: f32 = 10.0;

struct Verifier<'a, T: 'static> {
    wide: &'a WideTree,
    tree: &'a KdTree<3>,
    mesh: &'a TriangleMesh<T>,
    matching: Matching<'a>,
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

impl WideTree {
    /// Checks a wide tree, whose structure is known to be right, against the canonical tree, which is
    /// known to be valid.
    pub(crate) fn verify<T: Coordinate>(
        &self,
        tree: &KdTree<3>,
        mesh: &TriangleMesh<T>,
    ) -> Result<(), WideError> {
        let matching = Matching::new(self, tree);
        Verifier { wide: self, tree, mesh, matching }.verify()
    }
}

impl<T: Coordinate> Verifier<'_, T> {
    fn verify(&self) -> Result<(), WideError> {
        let root = Aabb { min: [f32::NEG_INFINITY; 3], max: [f32::INFINITY; 3] };
        let stand = Stand { node: 0, cell: *self.tree.bounds(), site: Site::ROOT, bounds: root };
        self.verify_node(Link::ROOT, &stand, levels_apart(self.tree))?;
        let homes = &self.wide.homes;
        let above = Homes::above_each_slot(homes.list(), &self.wide.arena);
        if above == **homes.numbers_above() { Ok(()) } else { Err(WideError::WrongNodeAbove) }
    }

    /// Verifies a wide node and all below it, on several threads for so many levels.
    fn verify_node(&self, link: Link, stand: &Stand, levels: usize) -> Result<(), WideError> {
        let node = self.wide.node(link);
        let number = self.verify_home(link, &stand.site)?;
        let wrong = WideError::NotTheTrees { line: link.line() };
        let parts = self.matching.parts(link, stand.node, stand.cell).ok_or(wrong)?;
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
        let number = self.wide.homes.number_at(link);
        let expected = Home::new(site, link, margin(FULL_MARGIN, self.wide.reach));
        let found = self.wide.homes.list().get(number as usize);
        let is_right = found.is_some_and(|home| bytes_of(home) == bytes_of(&expected));
        if is_right { Ok(number) } else { Err(WideError::BadHome { line: link.line() }) }
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
            let triangles = ids.iter().map(|&id| (id, self.mesh.rounded_corners(id)));
            let expected = TriangleBlock::new(triangles);
            let block = self.wide.block(link, index);
            if bytes_of(block) != bytes_of(&expected) {
                let line = link.line() + index * BLOCK_LINES;
                return Err(WideError::NotTheLeafs { line });
            }
        }
        let least = margin(LEAST_MARGIN, self.wide.reach);
        let fits = |&id: &u32| match self.mesh.inner_bounds(id, &stand.cell) {
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
            let site = Site { cell: Aabb::EMPTY, parent: number, place };
            let child = Link::from_bits(node.links()[place]);
            let part = Stand { site, bounds, ..*stand };
            self.verify_leaf(child, ids, &part, link)?;
        }
        Ok(())
    }
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
