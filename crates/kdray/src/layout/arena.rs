//! The memory of a wide tree: nodes and blocks between each other, in lines of 64 bytes.

use super::home::{Home, Site};
use super::size::{SLOT_BYTES, Size};
use super::{TriangleBlock, WideNode};
use crate::memory::{Store, Words};
use bytemuck::{Pod, Zeroable, must_cast, must_cast_ref};

/// As much as a processor fetches at once.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C, align(64))]
pub(crate) struct Line([u32; 16]);

impl Words for Line {}

pub(super) const NODE_LINES: usize = size_of::<WideNode>() / size_of::<Line>();
pub(super) const BLOCK_LINES: usize = size_of::<TriangleBlock>() / size_of::<Line>();

/// Where a child of a wide node lies, in four bytes: a node, or the blocks of a leaf.
///
/// Bit 31 tells a leaf; bits 28 to 30 are how many blocks it has; the others are its first line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Link(u32);

impl Link {
    /// A leaf of more blocks is cut into several.
    pub(crate) const MOST_BLOCKS: usize = 7;

    /// Arenas of so many lines, 16 GiB, or more cannot be linked: the link behind the last block must
    /// not carry into the number of blocks.
    pub(super) const MOST_LINES: usize = 1 << 28;

    /// The tree's first node.
    pub(crate) const ROOT: Self = Self(0);

    /// Leads nowhere: a leaf without blocks.
    pub(crate) const END: Self = Self(1 << 31);

    /// As it stands in a node.
    #[inline(always)]
    pub(crate) fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// To stand in a node.
    #[inline(always)]
    pub(crate) const fn to_bits(self) -> u32 {
        self.0
    }

    fn leaf(line: usize, blocks: usize) -> Self {
        debug_assert!(blocks <= Self::MOST_BLOCKS);
        Self(1 << 31 | (blocks as u32) << 28 | line as u32)
    }

    /// Whether it leads to the blocks of a leaf, not to a node.
    #[inline(always)]
    pub(crate) fn is_leaf(self) -> bool {
        self.0 >> 31 == 1
    }

    /// How many blocks the leaf has.
    #[inline(always)]
    pub(crate) fn block_count(self) -> usize {
        (self.0 >> 28 & 7) as usize
    }

    /// The leaf without its first block.
    #[inline(always)]
    pub(crate) fn rest(self) -> Self {
        Self(self.0.wrapping_sub(1 << 28).wrapping_add(BLOCK_LINES as u32))
    }

    #[inline(always)]
    pub(super) fn line(self) -> usize {
        self.0 as usize & (Self::MOST_LINES - 1)
    }
}

/// Nodes and blocks.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Arena {
    lines: Store<Line>,
}

/// Lines of an arena and homes that are yet to be filled, from the first on.
pub(super) struct Room<'a> {
    lines: &'a mut [Line],
    homes: &'a mut [Home],
    /// How much lies before.
    first: Size,
}

/// The place of a node whose children are being placed.
pub(super) struct NodeRoom<'a> {
    lines: &'a mut [Line],
    pub(super) link: Link,
    /// The number of the node's home.
    pub(super) home: u32,
}

impl<'a> Room<'a> {
    /// All of the lines, with as many homes as there will be nodes.
    pub(super) fn new(lines: &'a mut [Line], homes: &'a mut [Home]) -> Self {
        Self { lines, homes, first: Size::default() }
    }

    /// Takes the first part away.
    pub(super) fn take(&mut self, size: Size) -> Self {
        let (lines, other_lines) = std::mem::take(&mut self.lines).split_at_mut(size.lines);
        let (homes, other_homes) = std::mem::take(&mut self.homes).split_at_mut(size.nodes);
        let taken = Self { lines, homes, first: self.first };
        *self = Self { lines: other_lines, homes: other_homes, first: self.first + size };
        taken
    }

    /// Whether all of it was taken.
    pub(super) fn is_empty(&self) -> bool {
        self.lines.is_empty() && self.homes.is_empty()
    }

    /// Takes the room of a node, to be filled when its children are placed, and puts its home.
    pub(super) fn take_node(&mut self, site: &Site, pad: f64) -> NodeRoom<'a> {
        let Room { lines, homes, first } = self.take(Size::NODE);
        let link = Link(first.lines as u32);
        homes.fill(Home::new(site, link, pad));
        NodeRoom { lines, link, home: first.nodes as u32 }
    }

    /// Puts the blocks of a leaf.
    pub(super) fn put_leaf(
        &mut self,
        blocks: impl ExactSizeIterator<Item = TriangleBlock>,
    ) -> Link {
        let count = blocks.len();
        let Room { lines, first, .. } = self.take(Size::of_blocks(count));
        for (place, block) in lines.chunks_exact_mut(BLOCK_LINES).zip(blocks) {
            let block: [Line; BLOCK_LINES] = must_cast(block);
            place.copy_from_slice(&block);
        }
        Link::leaf(first.lines, count)
    }
}

impl NodeRoom<'_> {
    pub(super) fn put(self, node: WideNode) {
        let node: [Line; NODE_LINES] = must_cast(node);
        self.lines.copy_from_slice(&node);
    }
}

impl Arena {
    /// Whether so many lines are few enough to be linked.
    pub(super) fn can_link(lines: usize) -> bool {
        lines < Link::MOST_LINES
    }

    /// An arena of lines that are filled.
    pub(super) fn new(lines: Store<Line>) -> Self {
        Self { lines }
    }

    /// Nodes and blocks.
    pub(super) fn lines(&self) -> &Store<Line> {
        &self.lines
    }

    pub(super) fn slot_count(&self) -> usize {
        Size { lines: self.lines.len(), nodes: 0 }.slots()
    }

    /// The slot in which a block begins; of a block elsewhere anything. From its address, so that
    /// nobody need keep more of a block than a reference.
    pub(super) fn slot_of(&self, block: &TriangleBlock) -> usize {
        let begin = self.lines.as_ptr().addr();
        let bytes = std::ptr::from_ref(block).addr().wrapping_sub(begin);
        bytes / SLOT_BYTES
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(&*self.lines)
    }

    /// The node that a link leads to.
    #[inline(always)]
    pub(super) fn node(&self, link: Link) -> &WideNode {
        let line = link.line();
        let lines: &[Line; NODE_LINES] = as_array(&self.lines[line..line + NODE_LINES]);
        must_cast_ref(lines)
    }

    /// A block of the leaf that a link leads to.
    #[inline(always)]
    pub(super) fn block(&self, link: Link, index: usize) -> &TriangleBlock {
        let line = link.line() + index * BLOCK_LINES;
        let lines: &[Line; BLOCK_LINES] = as_array(&self.lines[line..line + BLOCK_LINES]);
        must_cast_ref(lines)
    }
}

#[inline(always)]
fn as_array<const N: usize>(lines: &[Line]) -> &[Line; N] {
    lines.first_chunk().expect("a slice of N lines")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_line_of_the_largest_arena_can_be_linked() {
        assert!(Arena::can_link(Link::MOST_LINES - 1) && !Arena::can_link(Link::MOST_LINES));
        let blocks = Link::MOST_BLOCKS;
        let first = Link::MOST_LINES - 1 - blocks * BLOCK_LINES;
        let mut link = Link::leaf(first, blocks);
        for passed in 0..blocks {
            let is_right = link.is_leaf() && link.block_count() == blocks - passed;
            assert!(is_right && link.line() == first + passed * BLOCK_LINES, "{passed}");
            link = link.rest();
        }
        assert!(link.is_leaf() && link.block_count() == 0);
    }
}
