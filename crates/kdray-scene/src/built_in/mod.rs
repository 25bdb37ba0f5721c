//! Scenes made by code.

mod assembly;
mod menger;
mod patterns;
mod showcase;
mod sphere;
mod torus_knot;

pub use showcase::showcase;
