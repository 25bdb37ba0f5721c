//! Forms of the tree that are fast to traverse, derived from the canonical one.
//!
//! [`WideTree`] collapses some three levels of the kd-tree into a node of eight children with tight
//! boxes, and puts copies of the triangles next to them, eight to a block. [`Clusters`]
//! are what winding numbers are summed over.

mod arena;
mod block;
mod clusters;
mod collapse;
mod error;
mod hint;
mod home;
mod homes;
mod matching;
mod moments;
mod node;
mod parts;
mod plan;
mod size;
mod structure;
mod treelet;
mod verify;
mod wide;

pub(crate) use arena::Link;
pub(crate) use block::TriangleBlock;
pub use clusters::{Cluster, Clusters};
pub use error::WideError;
pub use hint::Hint;
pub(crate) use home::Home;
pub(crate) use node::WideNode;
pub(crate) use parts::WideParts;
pub(crate) use wide::STACK_SIZE;
pub use wide::WideTree;
