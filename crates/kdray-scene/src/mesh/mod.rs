//! From polygons to the triangles of a model.

mod builder;
mod triangulate;

pub(crate) use builder::{Corner, MeshBuilder};
