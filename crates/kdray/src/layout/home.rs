//! The cells of wide nodes, and the way up.

use super::Link;
use crate::geometry::Aabb;
use crate::memory::Words;
use bytemuck::{Pod, Zeroable, must_cast_ref};

/// What is known of a wide node but not needed on the way down, in 32 bytes.
///
/// Cells of a kd-tree are disjoint. So if a ray's open part lies within a node's cell, all that it
/// hits is listed below that node, and nothing above it need be searched.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C, align(32))]
pub(crate) struct Home {
    /// The faces of the node's cell, moved inward by the tree's pad. Those on the outside of the tree
    /// are infinitely far away, because there is nothing behind them; all of the root's are.
    lower: [f32; 3],
    /// The number of the parent's home; the root's own.
    parent: u32,
    /// The upper faces, negated, so that all six are compared at once.
    upper: [f32; 3],
    /// Where the node lies: which child of its parent it is in the bits 28 to 30, above its line.
    node: u32,
}

impl Words for Home {}

const PLACE_SHIFT: u32 = 28;

/// A node's cell, and the node above it.
#[derive(Clone, Copy)]
pub(super) struct Site {
    pub(super) cell: Aabb<3>,
    /// The number of the parent's home.
    pub(super) parent: u32,
    /// Which of its children the node is.
    pub(super) place: usize,
}

impl Site {
    /// The root's: all of space.
    pub(super) const ROOT: Self = {
        let cell = Aabb { min: [f32::NEG_INFINITY; 3], max: [f32::INFINITY; 3] };
        Self { cell, parent: 0, place: 0 }
    };
}

impl Home {
    /// That of the node at `link`; the faces of its cell are moved inward by `pad` at least.
    pub(super) fn new(site: &Site, link: Link, pad: f64) -> Self {
        let Site { cell, parent, place } = site;
        let inward = |x: f32| {
            if x.is_finite() { ((f64::from(x) + pad) as f32).next_up() } else { x }
        };
        Self {
            lower: cell.min.map(inward),
            parent: *parent,
            upper: cell.max.map(|x| inward(-x)),
            node: link.to_bits() | (*place as u32) << PLACE_SHIFT,
        }
    }

    /// Whether it is that of the node at `link`, which is the child at `place` of a node whose home has
    /// the number `parent`.
    pub(super) fn is_at(&self, link: Link, parent: u32, place: u32) -> bool {
        self.node == (link.to_bits() | place << PLACE_SHIFT) && self.parent == parent
    }

    /// Whether the cell is all of space, as the root's is.
    pub(super) fn is_everywhere(&self) -> bool {
        self.lower == [f32::NEG_INFINITY; 3] && self.upper == [f32::NEG_INFINITY; 3]
    }

    /// The lower faces in the lanes 0 to 2, the upper ones, negated, in the lanes 4 to 6; in the
    /// others anything.
    #[inline(always)]
    pub(crate) fn faces(&self) -> &[f32; 8] {
        must_cast_ref(self)
    }

    /// The number of the parent's home.
    #[inline(always)]
    pub(crate) fn parent(&self) -> u32 {
        self.parent
    }

    /// Where the node lies.
    #[inline(always)]
    pub(crate) fn link(&self) -> Link {
        Link::from_bits(self.node & ((1 << PLACE_SHIFT) - 1))
    }

    /// Which child of its parent the node is.
    #[inline(always)]
    pub(crate) fn place(&self) -> u32 {
        self.node >> PLACE_SHIFT
    }
}
