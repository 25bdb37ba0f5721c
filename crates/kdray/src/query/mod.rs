//! The public face: scenes that answer queries.

mod all_hits;
mod arithmetic;
mod asked;
mod batch;
mod closest_point;
mod contains;
mod filtered;
mod instance;
mod instance_batch;
mod instance_hits;
mod instanced_scene;
mod near;
mod packet;
mod points;
mod precision;
mod scene;
mod shape_scene;
mod signed_distance;
mod thickness;
mod visible;
mod winding_number;

pub use crate::traverse::wide::packet::PacketWork;
pub use arithmetic::Arithmetic;
pub use instance::{Instance, InstanceError, InstanceHit};
pub use instance_hits::InstanceHits;
pub use instanced_scene::{InstancedScene, InstancedSceneError};
pub use precision::Precision;
pub use scene::Scene;
pub use shape_scene::ShapeScene;
