//! Why a picture could not be written. Pictures are encoded in memory before the first byte is
//! written, so that a writer's errors can be told from an encoder's.

use crate::options::PictureKind;
use crate::part::Part;
use std::error::Error as StdError;
use std::io;
use thiserror::Error;

/// Why a picture could not be written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The writer failed.
    #[error("the picture cannot be written; make room, or choose another place")]
    Io(#[source] io::Error),
    /// The picture has no pixels, or more across or down than the format can hold.
    #[error("a picture of {width} x {height} cannot be written; render sides from 1 to {limit}")]
    Size {
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
        /// The longest side that the format can hold.
        limit: u32,
    },
    /// A list of the picture is not as long as there are pixels.
    #[error(
        "a picture of {width} x {height} has {found} entries in `{list}`; give one for each pixel"
    )]
    Length {
        /// Which list: `rendered`, or a channel as `layer.channel`.
        list: String,
        /// Its length.
        found: usize,
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
    },
    /// The picture is no part of the one that it says it is part of.
    #[error("a picture cannot be this part: {0:?}; give pixels and samples that the whole has")]
    Part(Box<Part>),
    /// What a PNG shall show was not rendered, or the layer has other channels.
    #[error("the picture has no layer that shows {0:?}; render that kind, or all layers")]
    NotThere(PictureKind),
    /// The encoder refuses the picture.
    #[error("the picture cannot be encoded; change what the format cannot hold")]
    Encode(#[source] Box<dyn StdError + Send + Sync>),
}
