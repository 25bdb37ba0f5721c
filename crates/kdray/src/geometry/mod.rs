//! Rays and the plain shapes that a kd-tree is made of.

mod aabb;
mod bounding_sphere;
mod bounding_volume;
mod chord;
mod clip;
mod interval;
mod plane;
mod ray;
mod slack;

pub use aabb::Aabb;
pub use bounding_sphere::BoundingSphere;
pub use bounding_volume::BoundingVolume;
pub(crate) use chord::{Chord, chord};
pub use clip::{clipped_bounds, split_bounds};
pub use interval::Interval;
pub use plane::Plane;
pub use ray::{Ray, RayError};
pub(crate) use slack::{t_above, t_below, widened};
