//! Traversals of the wide tree, in f32 and eight lanes at a time, with exact answers.
//!
//! Everything in f32 is a *filter*: boxes are passed by only if the ray surely misses them, and
//! triangles only if the ray surely misses them or hits them surely behind the best hit. What is
//! left, the *candidates*, goes to [`crate::primitives::intersect_triangle`], which decides. So
//! hits are the same to the last bit as those of every other traversal.

mod aim;
mod batch;
mod block;
mod climb;
mod float;
mod located;
mod search;
mod single;
mod slab;
mod stack;
mod start;
mod vector;

pub(crate) use aim::NoAim;
pub(crate) use batch::Batch;
pub(crate) use located::Located;
pub(crate) use search::{Any, Closest, Search};
pub(crate) use single::{search_along, search_near};
pub(crate) use start::{Near, Start};
