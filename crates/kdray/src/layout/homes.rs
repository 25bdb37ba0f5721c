//! From hits to the nodes that they were found in.

use super::arena::Arena;
use super::home::Home;
use super::{Hint, Link, TriangleBlock};
use crate::memory::Store;

/// The homes of a wide tree's nodes, numbered in the order in which the nodes lie in memory.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Homes {
    homes: Store<Home>,
    /// For each slot of the arena in which a block begins the number of the home of the node above.
    above: Store<u32>,
}

impl Homes {
    /// How many bytes the homes of an arena of so many slots and nodes take.
    pub(super) fn bytes_of(slots: usize, nodes: usize) -> usize {
        slots * size_of::<u32>() + nodes * size_of::<Home>()
    }

    /// Finds the blocks below each node. The first home is the root's.
    pub(super) fn new(homes: Vec<Home>, arena: &Arena) -> Self {
        let above = Self::above_each_slot(&homes, arena);
        Self { homes: homes.into(), above: above.into() }
    }

    /// Homes with what [`above_each_slot`](Self::above_each_slot) says.
    pub(super) fn of_stores(homes: Store<Home>, above: Store<u32>) -> Self {
        Self { homes, above }
    }

    /// For each slot of the arena in which a block begins the number of the home of the node above.
    pub(super) fn above_each_slot(homes: &[Home], arena: &Arena) -> Vec<u32> {
        let mut above = vec![0; arena.slot_count()];
        for (number, home) in (0..).zip(homes) {
            for &bits in arena.node(home.link()).links() {
                let link = Link::from_bits(bits);
                if link.is_leaf() {
                    let blocks = (0..link.block_count()).map(|i| arena.block(link, i));
                    blocks.for_each(|block| above[arena.slot_of(block)] = number);
                }
            }
        }
        above
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

    /// All homes, the root's first.
    pub(super) fn list(&self) -> &Store<Home> {
        &self.homes
    }

    /// The number of the home of the node at `link`. Homes stand in the order of their nodes' lines.
    pub(super) fn number_at(&self, link: Link) -> u32 {
        self.homes.partition_point(|home| home.link().line() < link.line()) as u32
    }

    /// For each slot of the arena in which a block begins the number of the home of the node above.
    pub(super) fn numbers_above(&self) -> &Store<u32> {
        &self.above
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build::{BuildOptions, Preset};
    use crate::layout::WideTree;
    use crate::layout::wide::tests::{soup, wide};
    use std::collections::HashSet;

    /// The triangles below a node.
    fn below(tree: &WideTree, link: Link) -> HashSet<u32> {
        if link.is_leaf() {
            let blocks = (0..link.block_count()).map(|index| tree.block(link, index));
            let ids = |block: &TriangleBlock| (0..8).map(|lane| block.id(lane)).collect::<Vec<_>>();
            return blocks.flat_map(ids).collect();
        }
        let links = tree.node(link).links().iter().map(|&bits| Link::from_bits(bits));
        links.filter(|&link| link != Link::ROOT).flat_map(|link| below(tree, link)).collect()
    }

    fn is_inside(home: &Home, corner: &[f32; 3]) -> bool {
        let [a, b, c, _, d, e, f, _] = *home.faces();
        let [x, y, z] = *corner;
        x >= a && y >= b && z >= c && -x >= d && -y >= e && -z >= f
    }

    #[test]
    fn what_reaches_into_a_cell_is_listed_below_its_node() {
        let mesh = soup(2000);
        let few = BuildOptions { leaf_size: 100, ..BuildOptions::preset(Preset::Best) };
        let one = BuildOptions { leaf_size: usize::MAX, ..few };
        for options in [BuildOptions::preset(Preset::Fast), few, one] {
            let tree = wide(&mesh, &options);
            for home in tree.homes.list().iter() {
                let ids = below(&tree, home.link());
                for id in 0..2000 {
                    if mesh.corners(id).iter().any(|corner| is_inside(home, corner)) {
                        assert!(ids.contains(&id), "{id} is in {home:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn homes_lead_up_and_hints_lead_to_homes() {
        let tree = wide(&soup(2000), &BuildOptions::preset(Preset::Fast));
        for home in tree.homes.list().iter() {
            let above = tree.home_above(home);
            if home.link() != Link::ROOT {
                let links = tree.node(above.link()).links();
                assert_eq!(links[home.place() as usize], home.link().to_bits());
                for lane in [0, 1, 2, 4, 5, 6] {
                    assert!(home.faces()[lane] >= above.faces()[lane], "{home:?}, {above:?}");
                }
            }
            for &bits in tree.node(home.link()).links() {
                let link = Link::from_bits(bits);
                let blocks = if link.is_leaf() { link.block_count() } else { 0 };
                for index in 0..blocks {
                    assert_eq!(tree.home(tree.hint(tree.block(link, index))), home);
                }
            }
        }
        for stranger in [Hint::NONE, Hint(tree.homes.list().len() as u32)] {
            assert_eq!(tree.home(stranger).link(), Link::ROOT);
        }
    }
}
