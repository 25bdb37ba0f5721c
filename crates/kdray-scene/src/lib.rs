//! Meshes, materials, lights and cameras, from files and from code.
//!
//! [`load`] reads OBJ, PLY, STL, OFF, glTF and GLB files, also compressed ones, into a [`Model`].

pub mod built_in;
mod camera;
mod light;
mod material;
mod model;

pub use camera::{Camera, Projection};
pub use light::{Cone, Light};
pub use material::{AlphaMode, Material, Texture, TextureRef, Wrap};
pub use model::Model;
