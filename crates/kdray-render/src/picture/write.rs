//! Why a picture could not be written. Pictures are encoded in memory before the first byte is
//! written, so that a writer's errors can be told from an encoder's.

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
    /// The picture has more pixels across or down than the format can hold.
    #[error("a picture of {width} x {height} does not fit a PNG; write it as OpenEXR")]
    TooLarge {
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
    },
    /// The encoder refuses the picture.
    #[error("the picture cannot be encoded; its layers must have a number for each pixel")]
    Encode(#[source] Box<dyn StdError + Send + Sync>),
}
