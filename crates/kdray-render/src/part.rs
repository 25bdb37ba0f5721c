//! Which part of a picture is rendered: for machines that share one.

use std::fmt;
use std::ops::Range;

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Crop {
    /// The first column, from 0 at the left.
    pub x: usize,
    /// The first row, from 0 at the top.
    pub y: usize,
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
}

/// Which part of which picture a [`Picture`](crate::Picture) is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Pixels of the whole picture across.
    pub full_width: usize,
    /// Pixels of the whole picture down.
    pub full_height: usize,
    /// The column of the whole picture that is the part's first.
    pub x: usize,
    /// The row of the whole picture that is the part's first.
    pub y: usize,
    /// Camera rays a pixel in the whole picture.
    pub samples: u32,
    /// Which of them this part's means are of.
    pub sample_range: Range<u32>,
    /// What chose the random numbers.
    pub seed: u64,
    /// A hash of all else that the picture depends on: scene, camera, lights and options.
    pub scene: u64,
}

impl Crop {
    /// Whether it has pixels, and a picture of that size has all of them.
    pub fn is_within(&self, width: usize, height: usize) -> bool {
        let fits = |first: usize, length: usize, all: usize| {
            length > 0 && first.checked_add(length).is_some_and(|end| end <= all)
        };
        fits(self.x, self.width, width) && fits(self.y, self.height, height)
    }

    /// Whether the pixel (x, y) of the whole picture is one of these.
    pub fn contains(&self, [x, y]: [usize; 2]) -> bool {
        x.checked_sub(self.x).is_some_and(|x| x < self.width)
            && y.checked_sub(self.y).is_some_and(|y| y < self.height)
    }

    /// The pixels that are in both.
    pub(crate) fn overlap(&self, other: &Self) -> Option<Self> {
        let [x, width] = common([self.x, self.width], [other.x, other.width])?;
        let [y, height] = common([self.y, self.height], [other.y, other.height])?;
        Some(Self { x, y, width, height })
    }

    /// Its pixels in the whole picture, row by row.
    pub(crate) fn pixels(self) -> impl Iterator<Item = [usize; 2]> {
        let columns = self.x..self.x + self.width;
        (self.y..self.y + self.height).flat_map(move |y| columns.clone().map(move |x| [x, y]))
    }

    /// The place of a pixel of the whole picture among those of [`pixels`](Self::pixels).
    pub(crate) fn index(&self, [x, y]: [usize; 2]) -> usize {
        (y - self.y) * self.width + (x - self.x)
    }
}

impl Part {
    /// The pixels of a part of that size.
    pub(crate) fn crop(&self, width: usize, height: usize) -> Crop {
        Crop { x: self.x, y: self.y, width, height }
    }
}

/// As on the command line: `X,Y,WxH`.
impl fmt::Display for Crop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{},{}x{}", self.x, self.y, self.width, self.height)
    }
}

/// What two stretches, each a start and a length, have in common: a start and a length.
fn common([a, a_length]: [usize; 2], [b, b_length]: [usize; 2]) -> Option<[usize; 2]> {
    let start = a.max(b);
    let end = (a + a_length).min(b + b_length);
    (start < end).then(|| [start, end - start])
}

#[cfg(test)]
mod tests {
    use super::*;

    const CROP: Crop = Crop { x: 3, y: 1, width: 4, height: 2 };

    #[test]
    fn a_crop_lies_within_pictures_that_have_its_pixels() {
        assert!(CROP.is_within(7, 3) && CROP.is_within(100, 100));
        assert!(!CROP.is_within(6, 3) && !CROP.is_within(7, 2));
        for empty in [Crop { width: 0, ..CROP }, Crop { height: 0, ..CROP }] {
            assert!(!empty.is_within(100, 100));
        }
        assert!(!Crop { x: usize::MAX, ..CROP }.is_within(usize::MAX, 9));
    }

    #[test]
    fn pixels_are_counted_row_by_row() {
        let pixels: Vec<_> = CROP.pixels().collect();
        assert_eq!((pixels.len(), pixels[0], pixels[7]), (8, [3, 1], [6, 2]));
        for (i, &pixel) in pixels.iter().enumerate() {
            assert!(CROP.contains(pixel) && CROP.index(pixel) == i);
        }
        assert!(![[2, 1], [7, 1], [3, 0], [3, 3]].iter().any(|&pixel| CROP.contains(pixel)));
    }

    #[test]
    fn crops_overlap_where_both_have_pixels() {
        let other = Crop { x: 5, y: 0, width: 9, height: 2 };
        assert_eq!(CROP.overlap(&other), Some(Crop { x: 5, y: 1, width: 2, height: 1 }));
        assert_eq!(CROP.overlap(&Crop { x: 7, ..other }), None);
    }
}
