//! A render of the scene, to draw on.

use crate::{
    args::{Size, ViewArgs},
    cli::Globals,
    error::CliError,
    interrupt,
    progress::Progress,
};
use kdray_render::{PngDepth, RenderOptions, World};
use kdray_scene::Camera;
use std::path::Path;

/// The scene as a camera sees it.
pub(crate) struct Backdrop<'a> {
    pub(crate) world: &'a World,
    pub(crate) camera: &'a Camera,
    /// Whose lights shine, and whose sky it is.
    pub(crate) view: &'a ViewArgs,
    pub(crate) size: Size,
    /// Rays a pixel.
    pub(crate) samples: u32,
}

impl Backdrop<'_> {
    /// Renders it to the bytes of a PNG, for a picture in the file `out`.
    pub(crate) fn render(&self, out: &Path, globals: &Globals) -> Result<Vec<u8>, CliError> {
        let Self { world, camera, view, size: Size { width, height }, samples } = *self;
        let lights = view.lights(world.model(), world.scene().tree().bounds());
        let options = RenderOptions {
            width,
            height,
            samples,
            background: view.sky(),
            ..RenderOptions::default()
        };
        let progress = Progress::start("rendering", (width * height) as u64, "pixels", globals);
        let _watch = interrupt::watch();
        let render =
            kdray_render::render_with_progress(world, camera, &lights, &options, &|done| {
                progress.set_fraction(done.fraction);
                interrupt::flow()
            })?;
        if !render.complete {
            return Err(CliError::Interrupted);
        }
        let mut png = Vec::new();
        let written = render.write_png(&mut png, PngDepth::Eight);
        written.map_err(|error| CliError::picture(out, error))?;
        Ok(png)
    }
}
