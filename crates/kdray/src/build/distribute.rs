//! Step 4: the primitives that overlap L's box go to L, those that overlap R's box go to R.

use super::plane::{PlanarSide, SplitPlane};
use super::reference::Reference;
use crate::geometry::Aabb;
use crate::primitives::Primitives;

/// What became of each of a node's references.
#[derive(Default)]
pub(super) struct Distribution {
    /// For each reference of the node, in order.
    pub(super) fates: Vec<Fate>,
    /// The indices in the lower and the upper child of the references that were clipped anew.
    pub(super) clipped: [Vec<u32>; 2],
}

/// Where a reference went, in four bytes: to one child, with its bounds as they are and a new index
/// there; or it straddles the plane, and was clipped anew for both children.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Fate(u32);

impl Fate {
    const BELOW: u32 = 1 << 30;
    const ABOVE: u32 = 2 << 30;
    const CLIPPED: Self = Self(0);

    /// 1 if it went below as it is, else 0.
    #[inline]
    pub(super) fn is_below(self) -> usize {
        (self.0 >> 30 & 1) as usize
    }

    /// 1 if it went above as it is, else 0.
    #[inline]
    pub(super) fn is_above(self) -> usize {
        (self.0 >> 31) as usize
    }

    /// Its index in the child that it went to.
    #[inline]
    pub(super) fn index(self) -> u32 {
        self.0 & (Self::BELOW - 1)
    }
}

impl Distribution {
    /// Puts `references` into `below` and `above`, which are empty, in the same order.
    ///
    /// With lo and hi the bounds of a primitive on the plane's axis: it goes below if lo < split
    /// and above if hi > split; if it lies in the plane, to the side that the plane names. For
    /// every point of it in the closed cell there is then a child whose closed cell holds the
    /// point and that lists it. One that straddles the plane gets the bounds of its part in each
    /// child; those of all others are unchanged.
    pub(super) fn distribute<const K: usize>(
        &mut self,
        primitives: &impl Primitives<K>,
        references: &[Reference<K>],
        plane: SplitPlane,
        cells: [&Aabb<K>; 2],
        below: &mut Vec<Reference<K>>,
        above: &mut Vec<Reference<K>>,
    ) {
        self.fates.clear();
        self.clipped.iter_mut().for_each(Vec::clear);
        for reference in references {
            let (lo, hi) = (reference.bounds.min[plane.axis], reference.bounds.max[plane.axis]);
            let is_planar = lo == plane.position && hi == plane.position;
            let goes_below = lo < plane.position || is_planar && plane.planar == PlanarSide::Below;
            let goes_above = hi > plane.position || is_planar && plane.planar == PlanarSide::Above;
            let fate = match (goes_below, goes_above) {
                (true, true) => {
                    self.clip(primitives, reference, 0, cells[0], below);
                    self.clip(primitives, reference, 1, cells[1], above);
                    Fate::CLIPPED
                }
                (true, false) => {
                    below.push(*reference);
                    Fate(Fate::BELOW | (below.len() as u32 - 1))
                }
                _ => {
                    above.push(*reference);
                    Fate(Fate::ABOVE | (above.len() as u32 - 1))
                }
            };
            self.fates.push(fate);
        }
    }

    /// Puts the part of a straddling primitive that lies in `cell` into `child`, if there is any.
    fn clip<const K: usize>(
        &mut self,
        primitives: &impl Primitives<K>,
        reference: &Reference<K>,
        side: usize,
        cell: &Aabb<K>,
        child: &mut Vec<Reference<K>>,
    ) {
        let Some(part) = primitives.clipped_bounds(reference.id, cell) else { return };
        // Both boxes hold the part, so the shared one does. Bounds never grow on the way down.
        let bounds = part.intersection(&reference.bounds).intersection(cell);
        if !bounds.is_empty() {
            self.clipped[side].push(child.len() as u32);
            child.push(Reference::new(reference.id, bounds));
        }
    }
}
