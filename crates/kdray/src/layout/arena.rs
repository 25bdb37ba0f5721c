//! The memory of a wide tree: nodes and blocks between each other, in lines of 64 bytes.

use super::{TriangleBlock, WideNode};
use bytemuck::{Pod, Zeroable, must_cast, must_cast_ref};

/// As much as a processor fetches at once.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(64))]
struct Line([u32; 16]);

const NODE_LINES: usize = size_of::<WideNode>() / size_of::<Line>();
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
#[derive(Clone, Debug, Default)]
pub(super) struct Arena {
    lines: Vec<Line>,
}

impl Arena {
    /// Makes room for a node, to be filled when its children are placed.
    pub(super) fn reserve_node(&mut self) -> Link {
        let line = self.lines.len();
        self.lines.resize(line + NODE_LINES, Line::zeroed());
        Link(line as u32)
    }

    pub(super) fn set_node(&mut self, link: Link, node: WideNode) {
        let lines: [Line; NODE_LINES] = must_cast(node);
        self.lines[link.line()..][..NODE_LINES].copy_from_slice(&lines);
    }

    /// Adds the blocks of a leaf.
    pub(super) fn push_leaf(&mut self, blocks: impl IntoIterator<Item = TriangleBlock>) -> Link {
        let line = self.lines.len();
        for block in blocks {
            let lines: [Line; BLOCK_LINES] = must_cast(block);
            self.lines.extend_from_slice(&lines);
        }
        Link::leaf(line, (self.lines.len() - line) / BLOCK_LINES)
    }

    pub(super) fn is_full(&self) -> bool {
        self.lines.len() > Link::MOST_LINES
    }

    pub(super) fn shrink_to_fit(&mut self) {
        self.lines.shrink_to_fit();
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
