//! From a world and a camera to a picture, in tiles on all threads.

use crate::camera::{CameraError, View};
use crate::film::{Film, MAX_PICTURE_BYTES};
use crate::fingerprint;
use crate::light::{Lamp, LightError, default_lights};
use crate::options::{MAX_SAMPLES, RenderOptions};
use crate::part::Crop;
use crate::picture::Picture;
use crate::tile::TileTracer;
use crate::tiles::Tiles;
use crate::work::{RenderProgress, Work};
use crate::world::World;
use kdray_scene::{Camera, Light};
use rayon::prelude::*;
use std::ops::{ControlFlow, Range};
use thiserror::Error;

/// Why a picture cannot be rendered.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
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
        "a picture of {width} x {height} takes {bytes} bytes, more than {limit} or than there are; choose a smaller size or fewer layers"
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
    /// The crop has no pixels, or some that the picture has not.
    #[error(
        "the crop {crop} must have pixels, and all of them in the picture of {width} x {height}; change it"
    )]
    Crop {
        /// The crop.
        crop: Crop,
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
    },
    /// The range of samples is empty, or goes beyond those of a pixel.
    #[error("the sample range {}..{} must not be empty, nor end above the {samples} samples of a pixel; change it", range.start, range.end)]
    SampleRange {
        /// The range.
        range: Range<u32>,
        /// Samples a pixel.
        samples: u32,
    },
    /// An option is out of its range.
    #[error("the option `{option}` must be {must}")]
    Option {
        /// Which one.
        option: &'static str,
        /// What it must be.
        must: &'static str,
    },
}

/// Renders `world` as `camera` sees it by `lights`, or by [`default_lights`] if there are none.
///
/// ```
/// use kdray_render::{PngDepth, RenderOptions, World, Y_UP, frame, render};
/// use kdray_scene::Model;
/// let model = Model {
///     vertices: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
///     triangles: vec![[0, 1, 2]],
///     ..Model::default()
/// };
/// let world = World::new(model, &kdray::BuildOptions::default())?;
/// let options = RenderOptions { width: 24, height: 16, samples: 1, ..RenderOptions::default() };
/// let picture = render(&world, &frame(world.bounds(), Y_UP, 1.5), &[], &options)?;
/// let mut png = Vec::new();
/// picture.write_png(&mut png, PngDepth::Eight)?;
/// assert!(png.starts_with(b"\x89PNG"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// What about the size, the camera, the lights or the options is unusable, before any work.
pub fn render(
    world: &World,
    camera: &Camera,
    lights: &[Light],
    options: &RenderOptions,
) -> Result<Picture, RenderError> {
    render_with_progress(world, camera, lights, options, &|_| ControlFlow::Continue(()))
}

/// [`render()`] with word on how far it is.
///
/// Tiles are shared among the threads of the current rayon pool; the picture is the same bit for
/// bit for any number of them. `progress` is told after tiles, and at the end if there is more to
/// tell: from any thread, but never from two at once. If it answers [`ControlFlow::Break`], it is
/// not called again, tiles that are not begun are left out, and the picture says so in
/// [`complete`](Picture::complete).
///
/// # Errors
/// What about the size, the camera, the lights or the options is unusable, before any work.
pub fn render_with_progress(
    world: &World,
    camera: &Camera,
    lights: &[Light],
    options: &RenderOptions,
    progress: &(dyn Fn(RenderProgress) -> ControlFlow<()> + Sync),
) -> Result<Picture, RenderError> {
    let (width, height) = (options.width, options.height);
    if width == 0 || height == 0 {
        return Err(RenderError::EmptyPicture { width, height });
    }
    // Before the options: of a vector that is up for both, the camera has the clearer complaint.
    let view = View::new(camera, width as f64 / height as f64)?;
    check(options)?;
    let background = options.background.upright().ok_or(RenderError::Option {
        option: "background",
        must: "one colour, or a sky whose `up` has a direction",
    })?;
    let lamps = if lights.is_empty() {
        Lamp::all(&default_lights(camera, world.bounds()))
    } else {
        Lamp::all(lights)
    }?;
    let scene = fingerprint::of_picture(world, camera, lights, options);
    let window = options.window();
    let film = Film::new(options, scene).ok_or_else(|| RenderError::TooLarge {
        width: window.width,
        height: window.height,
        bytes: Film::bytes(options),
        limit: MAX_PICTURE_BYTES,
    })?;
    let tiles = Tiles { width, height, window };
    let work = Work::new(film, tiles, progress);
    let options = &RenderOptions { background, ..options.clone() };
    (0..tiles.count()).into_par_iter().for_each(|index| {
        if !work.is_stopped() {
            let mut tracer = TileTracer::new(world, &view, &lamps, options);
            let tile: Vec<[usize; 2]> = tiles.pixels(index).collect();
            work.keep(tracer.trace(&tile).into_iter(), tracer.rays());
            work.tell();
        }
    });
    Ok(work.finish())
}

/// Whether there is something to render, and it is of the picture.
fn check_part(options: &RenderOptions) -> Result<(), RenderError> {
    let (width, height, samples) = (options.width, options.height, options.samples);
    if let Some(crop) = options.crop {
        if !crop.is_within(width, height) {
            return Err(RenderError::Crop { crop, width, height });
        }
        // Random numbers tell so many columns and rows apart.
        if width.max(height) > u32::MAX as usize {
            let (option, must) = ("width` or `height", "below 2^32");
            return Err(RenderError::Option { option, must });
        }
    }
    match &options.sample_range {
        Some(range) if range.is_empty() || range.end > samples => {
            Err(RenderError::SampleRange { range: range.clone(), samples })
        }
        _ => Ok(()),
    }
}

fn check(options: &RenderOptions) -> Result<(), RenderError> {
    let in_range = |option, value: u32, range: Range<u32>, must| {
        if range.contains(&value) { Ok(()) } else { Err(RenderError::Option { option, must }) }
    };
    in_range("samples", options.samples, 1..MAX_SAMPLES + 1, "from 1 to 65536")?;
    check_part(options)?;
    in_range("max_bounces", options.max_bounces, 0..65, "at most 64")?;
    in_range("ambient_rays", options.ambient_rays, 0..1025, "at most 1024")?;
    in_range("light_samples", options.light_samples, 1..1025, "from 1 to 1024")?;
    let positive = |option, value: f64| {
        let must = "above zero and finite";
        let good = value > 0.0 && value.is_finite();
        if good { Ok(()) } else { Err(RenderError::Option { option, must }) }
    };
    positive("exposure", options.exposure.into())?;
    options.occlusion_distance.map_or(Ok(()), |d| positive("occlusion_distance", d))?;
    options.heat_max.map_or(Ok(()), |max| positive("heat_max", max.into()))
}
