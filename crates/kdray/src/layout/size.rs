//! How much room parts of a wide tree take.

use super::arena::{BLOCK_LINES, Line, NODE_LINES};
use std::iter::Sum;
use std::ops::{Add, Mul};

/// Nodes and blocks begin so many lines apart at the least, so that in each slot of as many lines at
/// most one begins.
const SLOT_LINES: usize = NODE_LINES;
pub(super) const SLOT_BYTES: usize = SLOT_LINES * size_of::<Line>();

/// How much room something takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Size {
    pub(super) lines: usize,
    pub(super) nodes: usize,
}

impl Size {
    pub(super) const NODE: Self = Self { lines: NODE_LINES, nodes: 1 };

    /// That of so many blocks.
    pub(super) fn of_blocks(count: usize) -> Self {
        Self { lines: count * BLOCK_LINES, nodes: 0 }
    }

    /// How many slots there are in so many lines.
    pub(super) fn slots(&self) -> usize {
        self.lines.div_ceil(SLOT_LINES)
    }

    /// How many bytes an arena of that size takes.
    pub(super) fn bytes(&self) -> usize {
        self.lines * size_of::<Line>()
    }
}

impl Add for Size {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { lines: self.lines + other.lines, nodes: self.nodes + other.nodes }
    }
}

impl Mul<Size> for usize {
    type Output = Size;

    fn mul(self, size: Size) -> Size {
        Size { lines: self * size.lines, nodes: self * size.nodes }
    }
}

impl Sum for Size {
    fn sum<I: Iterator<Item = Self>>(sizes: I) -> Self {
        sizes.fold(Self::default(), Add::add)
    }
}
