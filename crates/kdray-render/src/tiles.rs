//! A picture cut into pieces of work.

use kdray::geometry::tile_order;

/// The side of a tile in pixels.
const TILE: usize = kdray::geometry::TILE as usize;

/// A picture cut into tiles, row by row.
#[derive(Clone, Copy)]
pub(crate) struct Tiles {
    pub(crate) width: usize,
    pub(crate) height: usize,
}

impl Tiles {
    pub(crate) fn count(self) -> usize {
        self.width.div_ceil(TILE) * self.height.div_ceil(TILE)
    }

    /// The pixels of a tile, neighbours together.
    pub(crate) fn pixels(self, index: usize) -> impl Iterator<Item = [usize; 2]> {
        let across = self.width.div_ceil(TILE);
        let (x, y) = (index % across * TILE, index / across * TILE);
        let [across, down] = [self.width - x, self.height - y].map(|rest| rest.min(TILE) as u32);
        tile_order(across, down).map(move |[i, j]| [x + i as usize, y + j as usize])
    }
}
