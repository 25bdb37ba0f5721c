//! From hits to the nodes that they were found in.

use super::arena::Arena;
use super::home::Home;
use super::{Hint, Link, TriangleBlock};

/// The homes of a wide tree's nodes, numbered in the order in which the nodes lie in memory.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Homes {
    homes: Vec<Home>,
    /// For each slot of the arena in which a block begins the number of the home of the node above.
    above: Vec<u32>,
}

impl Homes {
    /// How many bytes the homes of an arena of so many slots and nodes take.
    pub(super) fn bytes_of(slots: usize, nodes: usize) -> usize {
        slots * size_of::<u32>() + nodes * size_of::<Home>()
    }

    /// Finds the blocks below each node. The first home is the root's.
    pub(super) fn new(homes: Vec<Home>, arena: &Arena) -> Self {
        let mut above = vec![0; arena.slot_count()];
        for (number, home) in (0..).zip(&homes) {
            for &bits in arena.node(home.link()).links() {
                let link = Link::from_bits(bits);
                if link.is_leaf() {
                    let blocks = (0..link.block_count()).map(|i| arena.block(link, i));
                    blocks.for_each(|block| above[arena.slot_of(block)] = number);
                }
            }
        }
        Self { homes, above }
    }

    pub(super) fn bytes(&self) -> usize {
        Self::bytes_of(self.above.len(), self.homes.len())
    }

    /// The home that a hint tells of; the root's if it tells of none.
    #[inline(always)]
    pub(super) fn of_hint(&self, hint: Hint) -> &Home {
        self.homes.get(hint.0 as usize).unwrap_or(&self.homes[0])
    }

    /// That of a node's parent; of the root the root's own.
    #[inline(always)]
    pub(super) fn above(&self, home: &Home) -> &Home {
        &self.homes[home.parent() as usize]
    }

    /// The hint of a hit in a block of the arena.
    pub(super) fn hint(&self, arena: &Arena, block: &TriangleBlock) -> Hint {
        self.above.get(arena.slot_of(block)).map_or(Hint::NONE, |&number| Hint(number))
    }

    #[cfg(test)]
    pub(super) fn list(&self) -> &[Home] {
        &self.homes
    }
}
