//! What a ray has hit: where exactly, which way it faces, and what it looks like there.

mod offset;
mod point;
mod texture;

#[cfg(test)]
mod tests;

pub(crate) use point::{Surface, opacity};
