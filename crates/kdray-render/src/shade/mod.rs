//! How much light comes back along a ray.

mod dielectric;
mod direct;
mod gloss;
mod shadow;
mod whitted;

pub(crate) use whitted::{Path, Tracer};
