//! Step 4: the primitives that overlap L's box go to L, those that overlap R's box go to R.

use super::parallel::map_pieces;
use super::plane::{PlanarSide, SplitPlane};
use super::reference::Reference;
use crate::geometry::Aabb;
use crate::primitives::Primitives;

/// What became of each of a node's references.
#[derive(Default)]
pub(super) struct Distribution<const K: usize> {
    /// The references of the lower child.
    pub(super) below: Vec<Reference<K>>,
    /// For each reference of the node, in order, if they are followed.
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

/// Nodes with more references than this are distributed on several threads, in pieces of as many.
const PIECE: usize = 1 << 15;

impl<const K: usize> Distribution<K> {
    /// Distributes the `references` from `first` on, whose part of `cell` the plane cuts: those
    /// above stay, in the same order; those below go to [`below`](Self::below).
    ///
    /// With lo and hi the bounds of a primitive on the plane's axis: it goes below if lo < split
    /// and above if hi > split; if it lies in the plane, to the side that the plane names. For
    /// every point of it in the closed cell there is then a child whose closed cell holds the
    /// point and that lists it. One that straddles the plane gets the bounds of its part in each
    /// child; those of all others are unchanged.
    ///
    /// Where each reference went is noted if it is to be followed.
    pub(super) fn distribute(
        &mut self,
        primitives: &impl Primitives<K>,
        references: &mut Vec<Reference<K>>,
        first: usize,
        plane: SplitPlane,
        cell: &Aabb<K>,
        follow: bool,
    ) {
        let all = &mut references[first..];
        let above = if follow {
            self.distribute_piece::<true>(primitives, all, plane, cell)
        } else if all.len() > PIECE {
            self.distribute_pieces(primitives, all, plane, cell)
        } else {
            self.distribute_piece::<false>(primitives, all, plane, cell)
        };
        references.truncate(first + above);
    }

    /// Distributes on several threads; returns how many stay above.
    fn distribute_pieces(
        &mut self,
        primitives: &impl Primitives<K>,
        references: &mut [Reference<K>],
        plane: SplitPlane,
        cell: &Aabb<K>,
    ) -> usize {
        let pieces = map_pieces(references, PIECE, |piece| {
            let mut distribution = Self::default();
            let above = distribution.distribute_piece::<false>(primitives, piece, plane, cell);
            (above, distribution.below)
        });
        self.below.clear();
        self.below.reserve_exact(pieces.iter().map(|(_, below)| below.len()).sum());
        let mut above = 0;
        for (index, (count, below)) in pieces.iter().enumerate() {
            let start = index * PIECE;
            references.copy_within(start..start + count, above);
            above += count;
            self.below.extend_from_slice(below);
        }
        above
    }

    /// Distributes in place; returns how many stay above.
    fn distribute_piece<const FOLLOW: bool>(
        &mut self,
        primitives: &impl Primitives<K>,
        references: &mut [Reference<K>],
        plane: SplitPlane,
        cell: &Aabb<K>,
    ) -> usize {
        self.below.clear();
        self.fates.clear();
        self.clipped.iter_mut().for_each(Vec::clear);
        let SplitPlane { axis, position, planar } = plane;
        let (cell_below, cell_above) = cell.split(axis, position);
        let mut above = 0;
        for next in 0..references.len() {
            let reference = references[next];
            let (lo, hi) = (reference.bounds.min[axis], reference.bounds.max[axis]);
            let is_planar = lo == position && hi == position;
            let goes_below = lo < position || is_planar && planar == PlanarSide::Below;
            let goes_above = hi > position || is_planar && planar == PlanarSide::Above;
            let fate = match (goes_below, goes_above) {
                (true, true) => {
                    let parts = primitives.split_bounds(reference.id, cell, axis, position);
                    if let Some(part) = reference.part(parts[0], &cell_below) {
                        self.clipped[0].push(self.below.len() as u32);
                        self.below.push(part);
                    }
                    if let Some(part) = reference.part(parts[1], &cell_above) {
                        self.clipped[1].push(above as u32);
                        references[above] = part;
                        above += 1;
                    }
                    Fate::CLIPPED
                }
                (true, false) => {
                    self.below.push(reference);
                    Fate(Fate::BELOW | (self.below.len() as u32 - 1))
                }
                _ => {
                    references[above] = reference;
                    above += 1;
                    Fate(Fate::ABOVE | (above as u32 - 1))
                }
            };
            if FOLLOW {
                self.fates.push(fate);
            }
        }
        above
    }
}
