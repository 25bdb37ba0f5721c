//! A picture as layers of numbers.

mod check;
mod exr;
mod false_color;
mod label;
mod legend;
mod plan;
mod png;
mod read;
mod write;

use crate::options::PictureKind;
use crate::part::{Crop, Part};

pub(crate) use plan::{COUNT, Plan, is_of_middle, plans};
pub use png::PngDepth;
pub use read::ReadError;
pub use write::WriteError;

/// A rendered picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels across: of a part, those that it has.
    pub width: usize,
    /// Pixels down, likewise.
    pub height: usize,
    /// What a PNG shows.
    pub kind: PictureKind,
    /// Whether every pixel was rendered, with all samples of the part's range.
    pub complete: bool,
    /// Whether each pixel was rendered, the upper row first. Those that were not are zero in every
    /// layer, also in alpha, and `u32::MAX` in that of ids.
    pub rendered: Vec<bool>,
    /// What a PNG multiplies colours by.
    pub exposure: f32,
    /// The cost that has the last colour of a heat map's scale; `None` is the 99.5th percentile.
    pub heat_max: Option<f32>,
    /// Which part of which picture it is.
    pub part: Part,
    /// The layers.
    pub layers: Vec<Layer>,
}

/// Channels that belong together.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Its name, such as `color` or `depth`.
    pub name: &'static str,
    /// The channels.
    pub channels: Vec<Channel>,
}

/// One number a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Its name, such as `R` or `Z`.
    pub name: &'static str,
    /// The numbers, the upper row first.
    pub samples: Samples,
}

/// The numbers of a channel.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    /// Floats.
    F32(Vec<f32>),
    /// Whole numbers, such as ids.
    U32(Vec<u32>),
}

impl Picture {
    /// The numbers of a channel of floats.
    pub fn floats(&self, layer: &str, channel: &str) -> Option<&[f32]> {
        match &self.channel(layer, channel)?.samples {
            Samples::F32(samples) => Some(samples),
            Samples::U32(_) => None,
        }
    }

    /// The numbers of a channel of whole numbers.
    pub fn ids(&self, layer: &str, channel: &str) -> Option<&[u32]> {
        match &self.channel(layer, channel)?.samples {
            Samples::U32(samples) => Some(samples),
            Samples::F32(_) => None,
        }
    }

    /// Its pixels in the whole picture.
    pub fn crop(&self) -> Crop {
        self.part.crop(self.width, self.height)
    }

    fn channel(&self, layer: &str, channel: &str) -> Option<&Channel> {
        let layer = self.layers.iter().find(|l| l.name == layer)?;
        layer.channels.iter().find(|c| c.name == channel)
    }
}
