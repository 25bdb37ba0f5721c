//! What can be wrong with a tree.

use thiserror::Error;

/// The first broken invariant that [`KdTree::validate`](super::KdTree::validate) found.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TreeError {
    /// The tree has no node at all.
    #[error("the tree has no root")]
    NoRoot,
    /// The root's box has a NaN or infinite bound, and is not the empty one of no primitives.
    #[error("the root's box is not finite")]
    BadBounds,
    /// Part of a primitive lies outside the root's box.
    #[error("primitive {primitive} is not inside the root's box")]
    OutsideBounds {
        /// The primitive.
        primitive: u32,
    },
    /// A child's index is past the last node.
    #[error("node {node} has a child {child}, but there are only {nodes} nodes")]
    ChildOutOfRange {
        /// The parent.
        node: u32,
        /// The child that does not exist.
        child: u32,
        /// How many nodes there are.
        nodes: usize,
    },
    /// A node does not stand where depth-first order has it: behind the last one of the subtree
    /// before it.
    #[error("node {node} stands where depth-first order has node {expected}")]
    NotDepthFirst {
        /// The node that a parent names.
        node: u32,
        /// The one that it should name.
        expected: u32,
    },
    /// Nodes behind the last one that the root reaches.
    #[error("only the first {reached} of {nodes} nodes belong to the tree")]
    UnreachedNodes {
        /// How many nodes the root reaches.
        reached: usize,
        /// How many there are.
        nodes: usize,
    },
    /// A split perpendicular to an axis that the space does not have.
    #[error("node {node} is cut on axis {axis} of a space of {dimensions}")]
    BadAxis {
        /// The node.
        node: u32,
        /// Its axis.
        axis: usize,
        /// K.
        dimensions: usize,
    },
    /// A split that does not lie strictly inside its node's cell, so that the children do not partition
    /// it, or one of them is flat.
    #[error("node {node} is cut on axis {axis} at {split}, which is not inside its cell")]
    SplitOutsideCell {
        /// The node.
        node: u32,
        /// The axis.
        axis: usize,
        /// Where the plane lies.
        split: f32,
    },
    /// A node deeper than traversal stacks allow.
    #[error("node {node} lies below {depth} splits; at most 64 are allowed")]
    TooDeep {
        /// The node.
        node: u32,
        /// How many splits lie above it.
        depth: u32,
    },
    /// A leaf's list is not the one behind that of the leaf before it.
    #[error("the list of leaf {node} starts at {first}, expected at {expected}")]
    ListsDoNotTile {
        /// The leaf.
        node: u32,
        /// Where its list starts.
        first: u32,
        /// Where the last leaf's ends.
        expected: u32,
    },
    /// A leaf's list goes on past the last reference.
    #[error("the list of leaf {node} goes on past the last of {references} references")]
    ListOutOfRange {
        /// The leaf.
        node: u32,
        /// How many references there are.
        references: usize,
    },
    /// References behind the last leaf's list.
    #[error("only the first {listed} of {references} references belong to a leaf")]
    UnlistedReferences {
        /// The end of the last leaf's list.
        listed: usize,
        /// How many references there are.
        references: usize,
    },
    /// A leaf lists a primitive that does not exist.
    #[error("leaf {node} lists primitive {primitive}, but there are only {count}")]
    NoSuchPrimitive {
        /// The leaf.
        node: u32,
        /// The id it lists.
        primitive: u32,
        /// How many primitives there are.
        count: usize,
    },
    /// A leaf's ids do not rise: one is listed twice or out of order.
    #[error("leaf {node} lists primitive {primitive} twice or out of order")]
    NotAscending {
        /// The leaf.
        node: u32,
        /// The id that is not above the one before it.
        primitive: u32,
    },
    /// A leaf lists a primitive that has no part in its cell.
    #[error("leaf {node} lists primitive {primitive}, which does not touch its cell")]
    DoesNotTouch {
        /// The leaf.
        node: u32,
        /// The primitive.
        primitive: u32,
    },
    /// Part of a primitive lies in a leaf's cell, but neither that leaf nor another one whose cell
    /// holds the part lists it.
    #[error("leaf {node} does not list primitive {primitive}, which lies partly in its cell")]
    Missing {
        /// The leaf.
        node: u32,
        /// The primitive.
        primitive: u32,
    },
    /// To find all primitives in the leaves takes so many steps that the tree was surely made to be slow.
    #[error("it takes more than {0} steps to check the tree; build it anew")]
    TooManySteps(u64),
}
