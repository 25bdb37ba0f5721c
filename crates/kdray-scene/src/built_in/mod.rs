//! Scenes made by code.

mod showcase;

pub use showcase::showcase;
