//! What can be wrong with a wide tree that comes from a file.

use thiserror::Error;

/// The first thing in a wide tree that is not as it should be. Lines are those of the arena, of 64
/// bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum WideError {
    /// The mesh is one that no wide tree is made of.
    #[error("a mesh of this size has no wide tree")]
    OutOfRange,
    /// A node or a leaf does not lie where depth-first order has it.
    #[error("a link does not lead to line {line} of the wide tree, where depth-first order has it")]
    NotDepthFirst {
        /// Where it should lie.
        line: usize,
    },
    /// A node or a leaf reaches beyond the last line.
    #[error("what begins in line {line} of the wide tree goes on past the last of {lines}")]
    PastTheEnd {
        /// Where it begins.
        line: usize,
        /// How many lines there are.
        lines: usize,
    },
    /// Lines, or numbers that belong to them, behind the last that the root reaches.
    #[error("only the first {reached} of {lines} lines of the wide tree belong to it")]
    Unreached {
        /// How many lines the root reaches.
        reached: usize,
        /// How many there are.
        lines: usize,
    },
    /// A leaf without triangles.
    #[error("the wide node in line {line} has a leaf without triangles")]
    EmptyLeaf {
        /// The node's line.
        line: usize,
    },
    /// A place without child has a box that rays meet.
    #[error("the wide node in line {line} has a box without a child")]
    BoxWithoutChild {
        /// The node's line.
        line: usize,
    },
    /// The order of the children for some octant is not one of all eight.
    #[error("the wide node in line {line} has an order that misses a child or repeats one")]
    BadOrder {
        /// The node's line.
        line: usize,
    },
    /// A traversal's stack would not do.
    #[error("the wide node in line {line} lies deeper than the stacks of traversals allow")]
    TooDeep {
        /// The node's line.
        line: usize,
    },
    /// What is known of a node's cell and of the node above it is missing or wrong.
    #[error("the home of the wide node in line {line} is missing or wrong")]
    BadHome {
        /// The node's line.
        line: usize,
    },
    /// A block has a triangle that does not exist.
    #[error("the block in line {line} of the wide tree has a triangle that does not exist")]
    NoSuchTriangle {
        /// The block's line.
        line: usize,
    },
    /// The children of a node are not parts of the canonical tree, or its order is not theirs.
    #[error("the wide node in line {line} is not one of the canonical tree")]
    NotTheTrees {
        /// The node's line.
        line: usize,
    },
    /// The triangles of a block are not those of the canonical tree's leaf and the mesh.
    #[error("the block in line {line} of the wide tree differs from the canonical tree's leaf")]
    NotTheLeafs {
        /// The block's line.
        line: usize,
    },
    /// The box of a child does not hold what lies below it, and the margin for rounding.
    #[error("the wide node in line {line} has a box that is too small for what is in it")]
    BoxTooSmall {
        /// The node's line.
        line: usize,
    },
    /// The node above some block is not the one that is named.
    #[error("the wide tree names a wrong node above a block")]
    WrongNodeAbove,
}
