//! The node of eight children.

use super::Link;
use crate::geometry::Aabb;
use bytemuck::{Pod, Zeroable};

/// Eight children in 256 bytes: their boxes, where they lie, and in which order a ray meets them.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(64))]
pub(crate) struct WideNode {
    /// For each axis the boxes' lower planes, then the upper ones; lane i is child i. The planes of a
    /// place without child are all infinitely far up, where no ray gets.
    planes: [[[f32; 8]; 2]; 3],
    links: [u32; 8],
    /// For each octant of directions (bit k: component k is negative) the places of the children,
    /// farthest first, four bits each from the lowest. A kd-tree's cells are disjoint, so the order
    /// is the same for all rays of an octant.
    order: [u32; 8],
}

impl WideNode {
    /// Most children that a node has.
    pub(crate) const WIDTH: usize = 8;

    /// A node without children; the order is that of the places.
    pub(super) const EMPTY: Self =
        Self { planes: { [[[f32::INFINITY; 8]; 2]; 3] }, links: [0; 8], order: [0x7654_3210; 8] };

    pub(super) fn set_child(&mut self, place: usize, bounds: &Aabb<3>, link: Link) {
        for axis in 0..3 {
            self.planes[axis][0][place] = bounds.min[axis];
            self.planes[axis][1][place] = bounds.max[axis];
        }
        self.links[place] = link.to_bits();
    }

    /// Sets the order of an octant; `places` is farthest first, and need not be complete.
    pub(super) fn set_order(&mut self, octant: usize, places: &[u8]) {
        let missing = (0..8).filter(|place| !places.contains(place));
        let all = places.iter().copied().chain(missing);
        self.order[octant] =
            all.enumerate().fold(0, |order, (i, place)| order | u32::from(place) << (4 * i));
    }

    /// The lower and the upper planes of the boxes on an axis.
    #[inline(always)]
    pub(crate) fn planes(&self, axis: usize) -> &[[f32; 8]; 2] {
        &self.planes[axis]
    }

    #[inline(always)]
    pub(crate) fn links(&self) -> &[u32; 8] {
        &self.links
    }

    #[inline(always)]
    pub(crate) fn order(&self, octant: usize) -> u32 {
        self.order[octant & 7]
    }
}
