//! Meshes, materials, lights and cameras, from files and from code.
//!
//! [`load()`] reads OBJ, PLY, STL, OFF, glTF and GLB files, also compressed ones, into a [`Model`].

#![forbid(unsafe_code)]

pub mod built_in;
mod camera;
mod cut;
mod error;
mod format;
mod formats;
mod input;
mod light;
mod load;
mod material;
mod mesh;
mod model;
mod number;
mod srgb;
mod textures;

pub use camera::{Camera, Projection};
pub use error::{LoadError, Place};
pub use format::Format;
pub use light::{Cone, Light};
pub use load::{LoadOptions, load, read};
pub use material::{AlphaMode, Material, Texture, TextureRef, Wrap};
pub use model::Model;
