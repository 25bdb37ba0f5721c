//! Whether a picture is in itself consistent. All of its fields can be set, so a writer looks
//! before it counts on them.

use super::label::is_range_of;
use super::{Picture, Samples, WriteError};

impl Picture {
    /// The pixels across and down, if a format takes sides up to `limit`, and every list of the
    /// picture has an entry for each pixel.
    pub(super) fn checked_size(&self, limit: u32) -> Result<[u32; 2], WriteError> {
        let (width, height) = (self.width, self.height);
        let fits = |side: usize| u32::try_from(side).ok().filter(|side| (1..=limit).contains(side));
        let (Some(across), Some(down)) = (fits(width), fits(height)) else {
            return Err(WriteError::Size { width, height, limit });
        };
        for (list, found) in self.lengths() {
            if width.checked_mul(height) != Some(found) {
                return Err(WriteError::Length { list, found, width, height });
            }
        }
        Ok([across, down])
    }

    /// The size of the whole picture, if its sides are up to `limit`, and the part is one of it.
    pub(super) fn checked_part(&self, limit: u32) -> Result<(usize, usize), WriteError> {
        let (width, height) = (self.part.full_width, self.part.full_height);
        if width.max(height) > limit as usize {
            return Err(WriteError::Size { width, height, limit });
        }
        let is_part = self.crop().is_within(width, height)
            && is_range_of(&self.part.sample_range, self.part.samples);
        if is_part {
            Ok((width, height))
        } else {
            Err(WriteError::Part(Box::new(self.part.clone())))
        }
    }

    /// Whether every list of the picture has an entry for each pixel.
    pub(crate) fn is_consistent(&self) -> bool {
        self.checked_size(u32::MAX).is_ok() && self.checked_part(u32::MAX).is_ok()
    }

    /// The name and the length of each list.
    fn lengths(&self) -> impl Iterator<Item = (String, usize)> {
        let channels = self.layers.iter().flat_map(|layer| {
            let name = |channel: &str| format!("{}.{channel}", layer.name);
            layer.channels.iter().map(move |it| (name(it.name), it.samples.len()))
        });
        std::iter::once(("rendered".to_owned(), self.rendered.len())).chain(channels)
    }
}

impl Samples {
    /// None, of the same kind.
    pub(crate) fn empty(&self) -> Self {
        match self {
            Self::F32(_) => Self::F32(Vec::new()),
            Self::U32(_) => Self::U32(Vec::new()),
        }
    }

    fn len(&self) -> usize {
        match self {
            Self::F32(samples) => samples.len(),
            Self::U32(samples) => samples.len(),
        }
    }
}
