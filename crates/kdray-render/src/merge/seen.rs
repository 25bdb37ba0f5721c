//! What is remembered of a part: which samples of which pixels it had.

use super::MergeError;
use crate::part::Crop;
use crate::picture::Picture;
use std::ops::Range;

/// Which samples of which pixels a part had.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    pub(super) name: String,
    pub(super) samples: Range<u32>,
    crop: Crop,
    /// Whether each pixel of the crop was rendered; `None` if all were.
    rendered: Option<Vec<bool>>,
}

impl Seen {
    pub(super) fn new(name: &str, part: &Picture) -> Self {
        let all = part.rendered.iter().all(|&rendered| rendered);
        Self {
            name: name.to_owned(),
            samples: part.part.sample_range.clone(),
            crop: part.crop(),
            rendered: (!all).then(|| part.rendered.clone()),
        }
    }

    /// Whether the part had this pixel of the whole picture.
    pub(super) fn has(&self, pixel: [usize; 2]) -> bool {
        let rendered = |rendered: &Vec<bool>| rendered[self.crop.index(pixel)];
        self.crop.contains(pixel) && self.rendered.as_ref().is_none_or(rendered)
    }

    /// Whether the part had this sample of this pixel.
    pub(super) fn has_sample(&self, pixel: [usize; 2], sample: u32) -> bool {
        self.samples.contains(&sample) && self.has(pixel)
    }

    /// An error if both parts have a sample of a pixel.
    pub(super) fn check_overlap(&self, other: &Self) -> Result<(), MergeError> {
        let sample = self.samples.start.max(other.samples.start);
        let both = self.samples.contains(&sample) && other.samples.contains(&sample);
        let Some(crop) = self.crop.overlap(&other.crop).filter(|_| both) else { return Ok(()) };
        match crop.pixels().find(|&pixel| self.has(pixel) && other.has(pixel)) {
            None => Ok(()),
            Some([x, y]) => {
                let (first, second) = (self.name.clone(), other.name.clone());
                Err(MergeError::Overlap { first, second, sample, x, y })
            }
        }
    }
}
