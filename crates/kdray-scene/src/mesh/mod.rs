//! From polygons to the triangles of a model.

mod builder;
mod repeated;
mod rounding;
mod triangulate;
mod weld;

pub(crate) use builder::{Corner, MeshBuilder};
pub(crate) use weld::Welder;
