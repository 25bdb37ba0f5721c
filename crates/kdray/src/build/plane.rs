//! What a strategy answers.

use crate::geometry::Aabb;

/// A plane perpendicular to an axis, and where primitives go that lie in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SplitPlane {
    pub(super) axis: usize,
    pub(super) position: f32,
    pub(super) planar: PlanarSide,
}

/// The child that gets the primitives that lie in the plane as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum PlanarSide {
    /// The lower child, the lecture's L.
    Below,
    /// The upper child, the lecture's R.
    Above,
}

impl SplitPlane {
    /// The plane at `position`, unless that is not strictly inside the cell. Planar primitives go
    /// below.
    pub(super) fn inside<const K: usize>(
        cell: &Aabb<K>,
        axis: usize,
        position: f32,
    ) -> Option<Self> {
        let is_inside = cell.min[axis] < position && position < cell.max[axis];
        is_inside.then_some(Self { axis, position, planar: PlanarSide::Below })
    }

    /// The plane through the middle of the cell, unless the cell is too thin to have one.
    pub(super) fn middle<const K: usize>(cell: &Aabb<K>, axis: usize) -> Option<Self> {
        Self::inside(cell, axis, cell.center()[axis] as f32)
    }

    /// The plane through the middle of the cell's longest side that is not too thin to have one.
    pub(super) fn middle_of_longest<const K: usize>(cell: &Aabb<K>) -> Option<Self> {
        cell.axes_by_length().into_iter().find_map(|axis| Self::middle(cell, axis))
    }
}
