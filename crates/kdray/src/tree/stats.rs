//! Figures of a tree.

/// What a tree is made of, and what it is expected to cost.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TreeStats {
    /// How many primitives the tree was built over.
    pub primitives: usize,
    /// All nodes.
    pub nodes: usize,
    /// Nodes that are not cut.
    pub leaves: usize,
    /// Leaves without primitives.
    pub empty_leaves: usize,
    /// The largest number of splits above a leaf.
    pub max_depth: usize,
    /// How many leaves there are at each depth, from zero to `max_depth`.
    pub leaves_at_depth: Vec<usize>,
    /// The largest number of primitives in a leaf.
    pub largest_leaf: usize,
    /// Entries of all leaves' lists together.
    pub references: usize,
    /// References over primitives: how often a primitive is listed on average; 0 without any.
    pub references_per_primitive: f64,
    /// The surface area heuristic's expectation for a random ray that meets the root's box, under
    /// the given cost model.
    pub sah_cost: f64,
    /// Memory of nodes and references.
    pub bytes: usize,
}
