//! Traversals of the wide tree, in f32 and eight lanes at a time, with exact answers.
//!
//! Everything in f32 is a *filter*: it may say of boxes and triangles that the ray surely misses them,
//! of triangles that it surely hits them, and of two hits which is surely nearer. Where it cannot tell,
//! and for the numbers of each hit that is reported, [`crate::primitives::intersect_triangle`]
//! decides. So hits are the same to the last bit as those of every other traversal.

mod aim;
mod all;
mod any;
mod batch;
mod block;
mod climb;
mod closest;
mod closest_point;
mod count;
mod float;
mod inside;
mod line;
mod located;
#[cfg(test)]
mod one_block;
pub(crate) mod packet;
mod recent;
mod rounding;
mod search;
mod single;
mod slab;
mod stack;
mod stacks;
mod start;
mod vector;

pub(crate) use all::All;
pub(crate) use any::Any;
pub(crate) use batch::search_along_each;
pub(crate) use closest::Closest;
pub(crate) use closest_point::closest_point;
pub(crate) use count::Count;
pub(crate) use inside::{Crossed, Inside, way_out};
pub(crate) use line::NoAim;
pub(crate) use located::Located;
pub(crate) use search::Search;
pub(crate) use single::{search_along, search_near};
pub(crate) use start::{Near, Start};
