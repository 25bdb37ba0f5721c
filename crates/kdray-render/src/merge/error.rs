//! Why parts cannot be put together.

use thiserror::Error;

/// Why parts cannot be put together.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MergeError {
    /// There are no parts.
    #[error("there are no parts; give at least one")]
    NoParts,
    /// A part's lists, size and range contradict each other.
    #[error("{part}: its size, range of samples and layers contradict each other; render it again")]
    Inconsistent {
        /// The part.
        part: String,
    },
    /// A part was itself put together from parts, of unlike samples.
    #[error("{part}: its pixels have unlike samples; give the parts that it was merged from")]
    Mixed {
        /// The part.
        part: String,
    },
    /// Two parts are of different pictures.
    #[error("{first} and {second} are parts of different pictures: {what}; give parts of one")]
    DifferentPictures {
        /// The part that was added first.
        first: String,
        /// The part that does not go with it.
        second: String,
        /// In what they differ.
        what: String,
    },
    /// Two parts have the same samples of a pixel.
    #[error(
        "{first} and {second} both have sample {sample} of pixel ({x}, {y}); leave out one of them"
    )]
    Overlap {
        /// The part that was added first.
        first: String,
        /// The other one.
        second: String,
        /// The first sample that both have.
        sample: u32,
        /// The column of the first pixel that both have.
        x: usize,
        /// Its row.
        y: usize,
    },
    /// Two parts have different values where they must have the same.
    #[error(
        "{first} and {second} differ in layer `{layer}` at pixel ({x}, {y}), which samples do not change; render both by the same kdray, on machines of one kind"
    )]
    Disagree {
        /// The part that was added first.
        first: String,
        /// The other one.
        second: String,
        /// The layer.
        layer: &'static str,
        /// The pixel's column.
        x: usize,
        /// The pixel's row.
        y: usize,
    },
    /// Pixels or samples are missing.
    #[error(
        "{pixels} of {all} pixels lack samples, the first of them ({x}, {y}), which has no sample {sample}; give the missing parts, or allow that they are missing"
    )]
    Missing {
        /// How many pixels lack samples.
        pixels: usize,
        /// Pixels of the picture.
        all: usize,
        /// The column of the first one.
        x: usize,
        /// Its row.
        y: usize,
        /// The first sample that it lacks.
        sample: u32,
    },
    /// The picture takes too much memory.
    #[error(
        "to merge a picture of {width} x {height} takes {bytes} bytes, more than {limit} or than there are; render it smaller, or with fewer layers"
    )]
    TooLarge {
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
        /// What it takes.
        bytes: u128,
        /// What it may take.
        limit: u128,
    },
}
