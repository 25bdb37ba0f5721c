//! How much light comes back along a ray.

mod bounce;
mod dielectric;
mod direct;
mod first;
mod gloss;
mod light_rays;
mod matt;
mod met;
mod shadow;
mod tracer;
mod whitted;

pub(crate) use direct::Surroundings;
pub(crate) use tracer::Tracer;
