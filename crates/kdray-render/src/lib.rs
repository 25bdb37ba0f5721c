//! Pictures of a model by backward ray tracing (Whitted 1980), with [`kdray`] finding the hits.
//!
//! The way of a picture: a [`World`] (a model and the kd-tree over its triangles), seen by a
//! camera (its own, or one that [`frame`] chooses), is [`render()`]ed with [`RenderOptions`] to a
//! [`Picture`] of named float layers, which is written as PNG or OpenEXR.

#![forbid(unsafe_code)]

mod bundle;
mod camera;
mod camera_rays;
mod film;
mod fingerprint;
mod light;
mod merge;
mod options;
mod part;
mod picture;
mod render;
mod sampling;
mod shade;
mod surface;
mod tile;
mod tiles;
mod work;
mod world;

pub use camera::{CameraError, View, Y_UP, frame};
pub use light::{LightError, default_lights, point_light_for};
pub use merge::{Merge, MergeError};
pub use options::{Background, PictureKind, RenderOptions};
pub use part::{Crop, Part};
pub use picture::{Channel, Layer, Picture, PngDepth, ReadError, Samples, WriteError};
pub use render::{RenderError, render, render_with_progress};
pub use surface::HitPoint;
pub use work::RenderProgress;
pub use world::{World, WorldError};
