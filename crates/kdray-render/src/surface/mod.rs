//! What a ray has hit: where exactly, which way it faces, and what it looks like there.

mod offset;
mod point;
mod texture;

pub(crate) use point::{Surface, opacity};
