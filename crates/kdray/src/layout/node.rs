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

    /// How many children there are.
    pub(super) fn child_count(&self) -> usize {
        self.links.iter().filter(|&&bits| Link::from_bits(bits) != Link::ROOT).count()
    }

    /// The box of the child at a place.
    pub(super) fn child_box(&self, place: usize) -> Aabb<3> {
        let corner = |side: usize| [0, 1, 2].map(|axis| self.planes[axis][side][place]);
        Aabb { min: corner(0), max: corner(1) }
    }

    /// Whether all planes of places without child are where no ray gets.
    pub(super) fn has_no_box_without_child(&self) -> bool {
        let mut is_far = [true; Self::WIDTH];
        for row in self.planes.as_flattened() {
            is_far.iter_mut().zip(row).for_each(|(far, &x)| *far &= x == f32::INFINITY);
        }
        let mut places = self.links.iter().zip(is_far);
        places.all(|(&bits, is_far)| is_far || Link::from_bits(bits) != Link::ROOT)
    }

    /// Whether each place comes once in the order of each octant.
    pub(super) fn orders_all(&self) -> bool {
        let seen = |order: u32| (0..8).fold(0_u32, |seen, i| seen | 1 << (order >> (4 * i) & 15));
        self.order.iter().fold(true, |all, &order| all & (seen(order) == 0xff))
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
