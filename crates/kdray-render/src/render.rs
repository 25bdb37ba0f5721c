//! Tiles in parallel.

use crate::camera::{CameraError, View};
use crate::light::LightError;
use crate::options::RenderOptions;
use crate::picture::{Channel, Layer, Picture, Samples};
use crate::world::World;
use kdray_scene::{Camera, Light};
use rayon::prelude::*;
use std::ops::ControlFlow;
use thiserror::Error;

/// How far a render is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderProgress {
    /// The part that is done, from 0 to 1.
    pub fraction: f64,
    /// Tiles that are done.
    pub tiles_done: usize,
    /// All tiles.
    pub tiles: usize,
    /// Rays of all kinds shot so far.
    pub rays: u64,
}

/// Why a picture cannot be rendered.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum RenderError {
    /// The picture has no pixels.
    #[error("a picture of {width} x {height} has no pixels; give a width and a height above zero")]
    EmptyPicture {
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
    },
    /// The picture would take too much memory.
    #[error(
        "a picture of {width} x {height} would take {bytes} bytes, more than {limit}; choose a smaller size or fewer layers"
    )]
    TooLarge {
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
        /// What the layers would take.
        bytes: u128,
        /// What they may take.
        limit: u128,
    },
    /// The camera is unusable.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// A light is unusable.
    #[error(transparent)]
    Light(#[from] LightError),
    /// An option is out of its range.
    #[error("the option `{option}` {reason}")]
    Option {
        /// Which one.
        option: &'static str,
        /// What is wrong, and what to give.
        reason: &'static str,
    },
}

/// Renders `world` as `camera` sees it.
///
/// # Errors
/// See [`RenderError`].
pub fn render(
    world: &World,
    camera: &Camera,
    lights: &[Light],
    options: &RenderOptions,
    progress: &(dyn Fn(RenderProgress) -> ControlFlow<()> + Sync),
) -> Result<Picture, RenderError> {
    let _ = lights;
    let (width, height) = (options.width, options.height);
    if width == 0 || height == 0 {
        return Err(RenderError::EmptyPicture { width, height });
    }
    let view = View::new(camera, width as f64 / height as f64)?;
    let values: Vec<[f32; 4]> = (0..width * height)
        .into_par_iter()
        .map(|pixel| {
            let x = ((pixel % width) as f64 + 0.5) / width as f64;
            let y = ((pixel / width) as f64 + 0.5) / height as f64;
            let ray = view.ray(x, y);
            match world.scene().closest_hit(&ray) {
                Some(hit) => {
                    let n = glam::DVec3::from(
                        world.scene().primitives().geometric_normal(hit.primitive_id),
                    );
                    let shade = n.normalize_or_zero().dot(ray.direction.into()).abs() as f32;
                    [shade, shade, shade, 1.0]
                }
                None => options.background.radiance(ray.direction.into()).extend(1.0).to_array(),
            }
        })
        .collect();
    let channel = |i: usize, name| Channel {
        name,
        samples: Samples::F32(values.iter().map(|v| v[i]).collect()),
    };
    let channels = vec![channel(0, "R"), channel(1, "G"), channel(2, "B"), channel(3, "A")];
    let _ = progress(RenderProgress { fraction: 1.0, tiles_done: 1, tiles: 1, rays: 0 });
    Ok(Picture {
        width,
        height,
        kind: options.picture,
        complete: true,
        exposure: options.exposure,
        layers: vec![Layer { name: "color", channels }],
    })
}
