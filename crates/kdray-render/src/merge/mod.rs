//! Parts of a picture, put together.

mod canvas;
mod error;
mod seen;

use crate::picture::{COUNT, Picture};
use canvas::Canvas;
pub use error::MergeError;
use seen::Seen;

/// Puts a picture together from parts, each of which has some of its pixels, or some of their samples.
///
/// Parts are added one by one, in any order, and need not be kept. Pixels that come from one part are
/// those of the picture rendered at once, bit for bit. Where samples come from several parts, layers
/// that are means become the mean of the parts' means, each weighted with its samples: in f64, so that
/// nothing but the rounding of the parts' means to f32 is lost. Layers of the pixel's middle (depth,
/// normal, id) are the same in each of these parts, or there is an error.
///
/// ```
/// use kdray_render::{Crop, Merge, RenderOptions, World, Y_UP, frame, render};
/// use kdray_scene::Model;
/// let model = Model {
///     vertices: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
///     triangles: vec![[0, 1, 2]],
///     ..Model::default()
/// };
/// let world = World::new(model, &kdray::BuildOptions::default())?;
/// let camera = frame(world.bounds(), Y_UP, 1.5);
/// let whole = RenderOptions { width: 24, height: 16, samples: 2, ..RenderOptions::default() };
/// let mut merge = Merge::default();
/// for x in [0, 12] {
///     let crop = Some(Crop { x, y: 0, width: 12, height: 16 });
///     let options = RenderOptions { crop, ..whole.clone() };
///     merge.add(&format!("from x = {x}"), &render(&world, &camera, &[], &options)?)?;
/// }
/// assert_eq!(merge.finish()?, render(&world, &camera, &[], &whole)?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Merge {
    allow_missing: bool,
    canvas: Option<Canvas>,
    seen: Vec<Seen>,
}

impl Merge {
    /// Lets pixels and samples be missing at the end. Pixels without any sample are then those that
    /// were not [`rendered`](Picture::rendered), and others have the mean of the samples that they have.
    #[must_use]
    pub fn allow_missing(self) -> Self {
        Self { allow_missing: true, ..self }
    }

    /// Adds a part, which errors call `name`. After an error nothing is changed, but for
    /// [`MergeError::Disagree`], after which the merge is of no more use.
    ///
    /// # Errors
    /// What keeps the part from being put together with those that were added before.
    pub fn add(&mut self, name: &str, part: &Picture) -> Result<(), MergeError> {
        if !part.is_consistent() {
            return Err(MergeError::Inconsistent { part: name.to_owned() });
        }
        if part.layers.iter().any(|layer| layer.name == COUNT.name) {
            return Err(MergeError::Mixed { part: name.to_owned() });
        }
        let seen = Seen::new(name, part);
        if let Some(canvas) = &self.canvas {
            let first = self.seen.first().map_or("", |seen| &seen.name);
            canvas.check_same_picture(first, name, part)?;
        }
        for before in &self.seen {
            before.check_overlap(&seen)?;
        }
        let mut canvas = match self.canvas.take() {
            Some(canvas) => canvas,
            None => Canvas::new(part)?,
        };
        let added = canvas.add(part);
        self.canvas = Some(canvas);
        if let Err((layer, pixel)) = added {
            let before = self.seen.iter().find(|before| before.has(pixel));
            let first = before.map_or_else(String::new, |before| before.name.clone());
            let second = name.to_owned();
            return Err(MergeError::Disagree { first, second, layer, x: pixel[0], y: pixel[1] });
        }
        self.seen.push(seen);
        Ok(())
    }

    /// The picture.
    ///
    /// # Errors
    /// What is missing.
    pub fn finish(self) -> Result<Picture, MergeError> {
        let Self { allow_missing, canvas, seen } = self;
        let canvas = canvas.ok_or(MergeError::NoParts)?;
        if !allow_missing {
            canvas.check_all_there(&seen)?;
        }
        let start = seen.iter().map(|seen| seen.samples.start).min().unwrap_or_default();
        let end = seen.iter().map(|seen| seen.samples.end).max().unwrap_or_default();
        Ok(canvas.develop(start..end))
    }
}
