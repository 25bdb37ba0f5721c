//! The node of eight children.

use super::Link;
use crate::geometry::Aabb;
use bytemuck::{Pod, Zeroable, must_cast_ref};

/// Eight children in 256 bytes: their boxes, where they lie, and in which order a ray meets them.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(64))]
pub(crate) struct WideNode {
    /// The boxes' lower planes on x, y, z, then the upper ones; lane i is child i. A place without
    /// child has a box that no ray hits.
    planes: [[f32; 8]; 6],
    links: [u32; 8],
    /// For each octant of directions (bit k: component k is negative) the places of the children,
    /// farthest first, four bits each from the lowest. A kd-tree's cells are disjoint, so the order
    /// is the same for all rays of an octant.
    order: [u32; 8],
}

/// Which planes of the boxes a ray meets first and last, on each axis: rows of a node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlaneRows {
    pub(crate) near: [usize; 3],
    pub(crate) far: [usize; 3],
}

impl PlaneRows {
    const BY_OCTANT: [Self; 8] = {
        let mut all = [Self { near: [0, 1, 2], far: [3, 4, 5] }; 8];
        let mut i = 0;
        while i < 24 {
            let (octant, axis) = (i / 3, i % 3);
            if octant >> axis & 1 == 1 {
                (all[octant].near[axis], all[octant].far[axis]) = (axis + 3, axis);
            }
            i += 1;
        }
        all
    };

    /// Those of an octant.
    #[inline(always)]
    pub(crate) fn of_octant(octant: usize) -> &'static Self {
        &Self::BY_OCTANT[octant & 7]
    }
}

impl WideNode {
    /// Most children that a node has.
    pub(crate) const WIDTH: usize = 8;

    /// A node without children; the order is that of the places.
    pub(super) const EMPTY: Self = Self {
        planes: {
            let (none, inf) = ([f32::INFINITY; 8], [f32::NEG_INFINITY; 8]);
            [none, none, none, inf, inf, inf]
        },
        links: [0; 8],
        order: [0x7654_3210; 8],
    };

    pub(super) fn set_child(&mut self, place: usize, bounds: &Aabb<3>, link: Link) {
        for axis in 0..3 {
            self.planes[axis][place] = bounds.min[axis];
            self.planes[axis + 3][place] = bounds.max[axis];
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

    /// A row of planes.
    #[inline(always)]
    pub(crate) fn planes(&self, row: usize) -> &[f32; 8] {
        // Eight rows, so that the mask spares the check of the index.
        let rows: &[[f32; 8]; 8] = must_cast_ref(self);
        &rows[row & 7]
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
