//! What must be true of every tree.

use thiserror::Error;

/// The first broken invariant that [`KdTree::validate`](super::KdTree::validate) found.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum TreeError {
    /// The tree has no node at all.
    #[error("the tree has no root")]
    NoRoot,
}
