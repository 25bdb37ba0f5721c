//! The public face: scenes that answer queries.

mod arithmetic;
mod batch;
mod near;
mod packet;
mod precision;
mod scene;
mod shape_scene;

pub use crate::traverse::wide::packet::PacketWork;
pub use arithmetic::Arithmetic;
pub use precision::Precision;
pub use scene::Scene;
pub use shape_scene::ShapeScene;
