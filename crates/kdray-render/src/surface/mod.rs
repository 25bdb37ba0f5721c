//! What a ray has hit: where exactly, which way it faces, and what it looks like there.

mod hit_point;
mod offset;
mod point;
mod texture;

#[cfg(test)]
mod tests;

pub use hit_point::HitPoint;
pub(crate) use point::{Surface, opacity};
