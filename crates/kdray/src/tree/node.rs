//! The 8-byte node.

use crate::memory::Words;
use bytemuck::{Pod, Zeroable};

/// A split or a leaf in 8 bytes. The two low bits of `tag` are the axis of a split, or 3 for a
/// leaf; the other 30 are the index of the upper child, or how many references the leaf has.
/// `payload` is the position of the split, or the index of the leaf's first reference.
#[derive(Clone, Copy, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct Node {
    payload: u32,
    tag: u32,
}

impl Words for Node {}

/// What a node is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NodeKind {
    /// A box cut in two. The lower child (the lecture's L) is the node right behind this one.
    Inner {
        /// The axis that the plane is perpendicular to.
        axis: usize,
        /// Where the plane lies on it.
        split: f32,
        /// The index of the upper child (the lecture's R).
        above: u32,
    },
    /// A box that is not cut.
    Leaf {
        /// The index of its first reference.
        first: u32,
        /// How many references it has.
        count: u32,
    },
}

const LEAF: u32 = 3;

impl Node {
    /// The largest index or count that fits a node.
    pub const MAX_INDEX: u32 = (1 << 30) - 1;

    /// A split. `axis` is at most 2 and `above` at most [`MAX_INDEX`](Self::MAX_INDEX).
    pub(crate) fn inner(axis: usize, split: f32, above: u32) -> Self {
        debug_assert!(axis < LEAF as usize && above <= Self::MAX_INDEX);
        Self { payload: split.to_bits(), tag: above << 2 | axis as u32 }
    }

    /// A leaf. `count` is at most [`MAX_INDEX`](Self::MAX_INDEX).
    pub(crate) fn leaf(first: u32, count: u32) -> Self {
        debug_assert!(count <= Self::MAX_INDEX);
        Self { payload: first, tag: count << 2 | LEAF }
    }

    /// What the node is.
    #[inline]
    pub fn kind(self) -> NodeKind {
        let (axis, number) = (self.tag & 3, self.tag >> 2);
        if axis == LEAF {
            NodeKind::Leaf { first: self.payload, count: number }
        } else {
            let split = f32::from_bits(self.payload);
            NodeKind::Inner { axis: axis as usize, split, above: number }
        }
    }
}

impl std::fmt::Debug for Node {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.kind().fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_packed_comes_back() {
        assert_eq!(size_of::<Node>(), 8);
        for axis in 0..3 {
            let kind = Node::inner(axis, -1.5, Node::MAX_INDEX).kind();
            assert_eq!(kind, NodeKind::Inner { axis, split: -1.5, above: Node::MAX_INDEX });
        }
        assert_eq!(Node::leaf(7, 0).kind(), NodeKind::Leaf { first: 7, count: 0 });
    }
}
