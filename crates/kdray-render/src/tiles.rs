//! A picture cut into pieces of work.

/// The side of a tile in pixels.
const TILE: usize = 16;

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

    /// The pixels of a tile.
    pub(crate) fn pixels(self, index: usize) -> impl Iterator<Item = [usize; 2]> {
        let across = self.width.div_ceil(TILE);
        let (x, y) = (index % across * TILE, index / across * TILE);
        let (columns, rows) = (x..(x + TILE).min(self.width), y..(y + TILE).min(self.height));
        rows.flat_map(move |y| columns.clone().map(move |x| [x, y]))
    }
}
