//! Whether a picture is in itself consistent. All of its fields can be set, so a writer looks
//! before it counts on them.

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
    fn len(&self) -> usize {
        match self {
            Self::F32(samples) => samples.len(),
            Self::U32(samples) => samples.len(),
        }
    }
}
