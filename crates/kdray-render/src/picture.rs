//! A picture as layers of numbers.

use crate::options::PictureKind;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A rendered picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// What a PNG shows.
    pub kind: PictureKind,
    /// Whether every tile was rendered. Pixels that were not are zero, also in alpha.
    pub complete: bool,
    /// What a PNG multiplies colours by.
    pub exposure: f32,
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

/// How finely a PNG tells colours apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PngDepth {
    /// 8 bits a channel.
    #[default]
    Eight,
    /// 16 bits a channel.
    Sixteen,
}

/// Why a picture could not be written.
#[derive(Debug, Error)]
pub enum WriteError {
    /// The file or its folder cannot be written to.
    #[error("cannot write {path}: {source}; choose another place or check its permissions")]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The picture does not fit the format.
    #[error("cannot encode {path}: {reason}")]
    Encode {
        /// The file.
        path: PathBuf,
        /// What the encoder says.
        reason: String,
    },
}

impl Picture {
    /// Writes what [`kind`](Self::kind) names as a PNG.
    ///
    /// # Errors
    /// See [`WriteError`].
    pub fn write_png(&self, path: impl AsRef<Path>, depth: PngDepth) -> Result<(), WriteError> {
        let _ = depth;
        let path = path.as_ref();
        let Some(Layer { channels, .. }) = self.layers.first() else { return Ok(()) };
        let mut bytes = Vec::new();
        for pixel in 0..self.width * self.height {
            for channel in channels.iter().take(4) {
                if let Samples::F32(samples) = &channel.samples {
                    bytes.push((samples[pixel].clamp(0.0, 1.0).powf(1.0 / 2.2) * 255.0) as u8);
                }
            }
        }
        image::save_buffer(
            path,
            &bytes,
            self.width as u32,
            self.height as u32,
            image::ColorType::Rgba8,
        )
        .map_err(|e| WriteError::Encode { path: path.into(), reason: e.to_string() })
    }

    /// Writes all layers as an OpenEXR.
    ///
    /// # Errors
    /// See [`WriteError`].
    pub fn write_exr(&self, path: impl AsRef<Path>) -> Result<(), WriteError> {
        let path = path.as_ref();
        Err(WriteError::Encode { path: path.into(), reason: "not yet".into() })
    }
}
