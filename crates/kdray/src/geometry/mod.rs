//! Rays and the plain shapes that a kd-tree is made of.

mod aabb;
mod bounding_sphere;
mod bounding_volume;
mod chord;
mod clip;
mod coordinate;
mod floats;
mod interval;
mod plane;
mod ray;
mod ray_packet;
mod slack;
mod tile_order;
mod tree_space;

pub use aabb::Aabb;
pub use bounding_sphere::BoundingSphere;
pub use bounding_volume::BoundingVolume;
pub(crate) use chord::{Chord, chord};
pub(crate) use clip::{bounds_of, clipped_bounds_of, inner_bounds_of, split_bounds_of};
pub use clip::{clipped_bounds, split_bounds};
pub use coordinate::Coordinate;
pub(crate) use floats::{ROUNDING, inverse_power_of_two, power_of_two_below};
pub use interval::Interval;
pub use plane::Plane;
pub use ray::{Ray, RayError};
pub use ray_packet::{Common, RayPacket};
pub(crate) use slack::{t_above, t_below, widened};
pub use tile_order::{TILE, tile_order};
pub use tree_space::TreeSpace;
