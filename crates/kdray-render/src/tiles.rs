//! A picture cut into pieces of work.

use crate::part::Crop;
use kdray::geometry::tile_order;
use std::ops::Range;

/// The side of a tile in pixels.
const TILE: usize = kdray::geometry::TILE as usize;

/// A picture cut into tiles, row by row; of them those that have pixels in a window.
#[derive(Clone, Copy)]
pub(crate) struct Tiles {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) window: Crop,
}

impl Tiles {
    pub(crate) fn count(self) -> usize {
        self.columns().len() * self.rows().len()
    }

    /// All pixels of a tile, also those outside the window, neighbours together.
    pub(crate) fn pixels(self, index: usize) -> impl Iterator<Item = [usize; 2]> {
        let (columns, rows) = (self.columns(), self.rows());
        let x = (columns.start + index % columns.len()) * TILE;
        let y = (rows.start + index / columns.len()) * TILE;
        let [across, down] = [self.width - x, self.height - y].map(|rest| rest.min(TILE) as u32);
        tile_order(across, down).map(move |[i, j]| [x + i as usize, y + j as usize])
    }

    fn columns(self) -> Range<usize> {
        self.window.x / TILE..(self.window.x + self.window.width).div_ceil(TILE)
    }

    fn rows(self) -> Range<usize> {
        self.window.y / TILE..(self.window.y + self.window.height).div_ceil(TILE)
    }
}
