//! The memory of a wide tree: nodes and blocks between each other, in lines of 64 bytes.

use super::{TriangleBlock, WideNode};
use bytemuck::allocation::zeroed_vec;
use bytemuck::{Pod, Zeroable, must_cast, must_cast_ref};

/// As much as a processor fetches at once.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C, align(64))]
struct Line([u32; 16]);

pub(super) const NODE_LINES: usize = size_of::<WideNode>() / size_of::<Line>();
const BLOCK_LINES: usize = size_of::<TriangleBlock>() / size_of::<Line>();

/// Where a child of a wide node lies, in four bytes: a node, or the blocks of a leaf.
///
/// Bit 31 tells a leaf; bits 28 to 30 are how many blocks it has; the others are its first line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Link(u32);

impl Link {
    /// A leaf of more blocks is cut into several.
    pub(crate) const MOST_BLOCKS: usize = 7;

    /// Arenas of more lines, 16 GiB, cannot be linked.
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
    fn line(self) -> usize {
        self.0 as usize & (Self::MOST_LINES - 1)
    }
}

/// Nodes and blocks.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Arena {
    lines: Vec<Line>,
}

/// Lines of an arena that are yet to be filled, from the first on.
pub(super) struct Room<'a> {
    lines: &'a mut [Line],
    /// The number of the first line in the arena.
    first: usize,
}

/// The place of a node whose children are being placed.
pub(super) struct NodeRoom<'a>(&'a mut [Line]);

/// How many lines so many blocks take.
pub(super) fn leaf_lines(blocks: usize) -> usize {
    blocks * BLOCK_LINES
}

impl<'a> Room<'a> {
    /// Takes the first lines away.
    pub(super) fn take(&mut self, lines: usize) -> Self {
        let (taken, rest) = std::mem::take(&mut self.lines).split_at_mut(lines);
        let taken = Self { lines: taken, first: self.first };
        (self.lines, self.first) = (rest, self.first + lines);
        taken
    }

    /// Whether all of it was taken.
    pub(super) fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }

    /// Takes the room of a node, to be filled when its children are placed.
    pub(super) fn take_node(&mut self) -> (Link, NodeRoom<'a>) {
        let Room { lines, first } = self.take(NODE_LINES);
        (Link(first as u32), NodeRoom(lines))
    }

    /// Puts the blocks of a leaf.
    pub(super) fn put_leaf(
        &mut self,
        blocks: impl ExactSizeIterator<Item = TriangleBlock>,
    ) -> Link {
        let count = blocks.len();
        let Room { lines, first } = self.take(leaf_lines(count));
        for (place, block) in lines.chunks_exact_mut(BLOCK_LINES).zip(blocks) {
            let block: [Line; BLOCK_LINES] = must_cast(block);
            place.copy_from_slice(&block);
        }
        Link::leaf(first, count)
    }
}

impl NodeRoom<'_> {
    pub(super) fn put(self, node: WideNode) {
        let node: [Line; NODE_LINES] = must_cast(node);
        self.0.copy_from_slice(&node);
    }
}

impl Arena {
    /// How many bytes an arena of so many lines takes.
    pub(super) fn bytes_of(lines: usize) -> usize {
        lines * size_of::<Line>()
    }

    /// An arena of so many lines; `None` if they are too many to be linked.
    pub(super) fn new(lines: usize) -> Option<Self> {
        (lines <= Link::MOST_LINES).then(|| Self { lines: zeroed_vec(lines) })
    }

    /// All of it.
    pub(super) fn room(&mut self) -> Room<'_> {
        Room { lines: &mut self.lines, first: 0 }
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.lines.as_slice())
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
