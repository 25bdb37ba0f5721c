//! Object bounding volumes (S1): a cheap shape that is tested before what it holds.

use super::{Aabb, Interval, Ray};

/// A shape that wholly holds an object, so that a ray which misses the shape misses the object.
pub trait BoundingVolume<const K: usize> {
    /// The part of the ray's interval that may lie inside; `None` only if none does.
    fn ray_interval(&self, ray: &Ray<K>) -> Option<Interval>;
}

impl<const K: usize> BoundingVolume<K> for Aabb<K> {
    fn ray_interval(&self, ray: &Ray<K>) -> Option<Interval> {
        self.slab(ray)
    }
}
