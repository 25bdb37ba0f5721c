//! Pictures of trees, rays and measurements.
//!
//! Everything is drawn once, as SVG on a [`Canvas`]; a PNG is that SVG rasterised with an embedded
//! font, so that it looks the same on a machine without fonts. Two-dimensional pictures of a tree
//! are a [`Section`]: a plane through the boxes, in which every cell is a rectangle.

mod bars;
mod canvas;
mod cells;
mod file;
mod frustum_path;
mod frustum_view;
mod legend;
mod over_render;
mod palette;
mod panel;
mod projector;
mod ray_path;
mod section;
mod slice;
mod t_diagram;
mod wireframe;

use crate::args::SceneArgs;
use std::path::Path;

pub(crate) use bars::{Bars, Series, draw_bars};
pub(crate) use canvas::Canvas;
pub(crate) use file::PictureFile;
pub(crate) use frustum_path::{FrustumPath, draw_frustum_path};
pub(crate) use frustum_view::{FrustumView, draw_frustum_view};
pub(crate) use ray_path::{RayPath, draw_ray_path};
pub(crate) use section::Section;
pub(crate) use slice::{Slice, draw_slice};
pub(crate) use wireframe::{AROUND, LineColor, Wireframe, draw_wireframe};

/// What a picture calls the scene: its file's name, without what XML does not allow.
pub(crate) fn scene_name(args: &SceneArgs) -> String {
    match args.scene.as_deref() {
        None => "built-in scene".into(),
        Some(path) if path == Path::new("-") => "standard input".into(),
        Some(path) => {
            let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
            let is_allowed = |c: &char| !c.is_control() && !matches!(c, '\u{fffe}' | '\u{ffff}');
            let allowed = |c| Some(c).filter(is_allowed).unwrap_or(char::REPLACEMENT_CHARACTER);
            name.chars().map(allowed).collect()
        }
    }
}
