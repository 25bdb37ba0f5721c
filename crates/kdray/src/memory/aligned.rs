//! Bytes that begin at a line of the cache.

use bytemuck::{Pod, Zeroable, cast_slice, cast_slice_mut};

/// As much as a processor fetches at once.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(64))]
struct Line([u8; 64]);

/// Bytes that begin at a multiple of 64, as the sections of a tree file do: what is read into them need
/// not be copied again to be used.
#[derive(Clone, Debug, Default)]
pub struct AlignedBytes {
    lines: Vec<Line>,
    len: usize,
}

impl AlignedBytes {
    /// So many zeros; `None` if there is not enough memory.
    pub fn zeroed(len: usize) -> Option<Self> {
        let count = len.div_ceil(size_of::<Line>());
        let lines = bytemuck::allocation::try_zeroed_slice_box(count).ok()?;
        Some(Self { lines: lines.into_vec(), len })
    }

    /// The bytes, to be filled.
    pub fn as_mut_slice(&mut self) -> &mut [u8] {
        &mut cast_slice_mut(&mut self.lines)[..self.len]
    }
}

impl AsRef<[u8]> for AlignedBytes {
    fn as_ref(&self) -> &[u8] {
        &cast_slice(&self.lines)[..self.len]
    }
}

impl From<&[u8]> for AlignedBytes {
    fn from(bytes: &[u8]) -> Self {
        let zeros = Line::zeroed();
        let mut copy =
            Self { lines: vec![zeros; bytes.len().div_ceil(size_of::<Line>())], len: bytes.len() };
        copy.as_mut_slice().copy_from_slice(bytes);
        copy
    }
}
