//! A wide tree as arrays, to be saved, and back.

use super::arena::{Arena, Line};
use super::home::Home;
use super::homes::Homes;
use super::wide::reach;
use super::{WideError, WideTree, structure};
use crate::geometry::Coordinate;
use crate::memory::Store;
use crate::primitives::{Primitives, TriangleMesh};
use crate::tree::KdTree;

/// All that a wide tree is made of, but for its reach, which follows from the root's box.
#[derive(Clone, Default)]
pub(crate) struct WideParts {
    pub(crate) lines: Store<Line>,
    pub(crate) homes: Store<Home>,
    /// For each slot of the arena the number of the home above the block that begins there.
    pub(crate) above: Store<u32>,
}

impl WideParts {
    /// Whether there is nothing at all.
    pub(crate) fn is_empty(&self) -> bool {
        self.lines.is_empty() && self.homes.is_empty() && self.above.is_empty()
    }
}

impl WideTree {
    /// What it is made of; nothing is copied.
    pub(crate) fn parts(&self) -> WideParts {
        WideParts {
            lines: self.arena.lines().clone(),
            homes: self.homes.list().clone(),
            above: self.homes.numbers_above().clone(),
        }
    }

    /// The tree that the parts make, if its structure is right: the wide form of `tree`, which is one over
    /// `mesh`.
    pub(crate) fn of_parts<T: Coordinate>(
        parts: WideParts,
        tree: &KdTree<3>,
        mesh: &TriangleMesh<T>,
    ) -> Result<Self, WideError> {
        let WideParts { lines, homes, above } = parts;
        let reach = reach(tree.bounds()).filter(|_| Arena::can_link(lines.len()));
        let reach = reach.ok_or(WideError::OutOfRange)?;
        let arena = Arena::new(lines);
        structure::check(&arena, &homes, mesh.count())?;
        if above.len() != arena.slot_count() {
            return Err(WideError::Unreached { reached: arena.slot_count(), lines: above.len() });
        }
        let (homes, space) = (Homes::of_stores(homes, above), *mesh.tree_space());
        Ok(Self { homes, arena, reach, space })
    }
}
