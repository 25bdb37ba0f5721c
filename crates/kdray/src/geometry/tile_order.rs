//! The order in which the rays of a picture are put into packets.

/// Pixels across and down of a tile, the rays through which are the largest packet.
pub const TILE: u32 = 16;

/// The pixels of a picture, neighbours together: tiles of [`TILE`] x [`TILE`] pixels row by row; in a tile
/// four blocks of 8 x 8; in a block eight groups of 4 x 2. Tiles at the right and at the lower border
/// have only the pixels that the picture has.
///
/// So eight rays that follow each other are as near to each other as can be, and so are 64 and 256:
/// what a [`RayPacket`](super::RayPacket) wants. Where a tile is not whole its pixels are fewer, and
/// what follows shifts: a width and a height that are multiples of [`TILE`] make the best packets.
///
/// ```
/// use kdray::RayPacket;
/// use kdray::geometry::tile_order;
///
/// // A camera at the origin that looks along z, and a picture of 40 x 30 pixels.
/// let direction = |[x, y]: [u32; 2]| [f64::from(x) - 19.5, 14.5 - f64::from(y), 40.0];
/// let directions: Vec<[f64; 3]> = tile_order(40, 30).map(direction).collect();
/// let [x, y, z] = [0, 1, 2].map(|k| directions.iter().map(|d| d[k]).collect::<Vec<_>>());
/// let packet = RayPacket::from([0.0; 3], [&x, &y, &z]);
/// assert_eq!(packet.len(), 40 * 30);
/// // Where each ray's answer belongs in a picture that is stored row by row.
/// let places = tile_order(40, 30).map(|[x, y]| y * 40 + x);
/// assert_eq!(places.take(9).collect::<Vec<_>>(), [0, 1, 2, 3, 40, 41, 42, 43, 4]);
/// ```
pub fn tile_order(width: u32, height: u32) -> impl Iterator<Item = [u32; 2]> {
    let corner = move |y| (0..width).step_by(TILE as usize).map(move |x| [x, y]);
    let corners = (0..height).step_by(TILE as usize).flat_map(corner);
    corners.flat_map(move |[x, y]| {
        let is_there = move |[i, j]: &[u32; 2]| *i < width - x && *j < height - y;
        (0..TILE * TILE).map(in_tile).filter(is_there).map(move |[i, j]| [x + i, y + j])
    })
}

/// The pixel at a place of a whole tile.
fn in_tile(place: u32) -> [u32; 2] {
    let (block, group, pixel) = (place / 64, place / 8 % 8, place % 8);
    let x = block % 2 * 8 + group % 2 * 4 + pixel % 4;
    let y = block / 2 * 8 + group / 2 * 2 + pixel / 4;
    [x, y]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_comes_once() {
        for (width, height) in
            [(48, 32), (16, 16), (17, 31), (1, 40), (40, 1), (5, 3), (0, 9), (9, 0)]
        {
            let mut pixels: Vec<_> = tile_order(width, height).collect();
            pixels.sort_unstable();
            let all = (0..width).flat_map(|x| (0..height).map(move |y| [x, y]));
            assert!(pixels.into_iter().eq(all), "{width} x {height}");
        }
    }

    #[test]
    fn pixels_that_follow_each_other_are_compact() {
        let pixels: Vec<_> = tile_order(48, 32).collect();
        for (count, extent) in [(8, [4, 2]), (64, [8, 8]), (256, [16, 16])] {
            for group in pixels.chunks(count) {
                for (k, extent) in extent.into_iter().enumerate() {
                    let values = || group.iter().map(|pixel| pixel[k]);
                    let ends = values().max().zip(values().min());
                    assert_eq!(ends.map(|(most, least)| most - least + 1), Some(extent));
                }
            }
        }
    }

    #[test]
    fn tiles_come_row_by_row_and_end_at_the_border() {
        let pixels: Vec<_> = tile_order(20, 18).collect();
        assert_eq!(pixels[..5], [[0, 0], [1, 0], [2, 0], [3, 0], [0, 1]]);
        // Four pixels across of the second tile, then two down of the third.
        assert_eq!(pixels[256..261], [[16, 0], [17, 0], [18, 0], [19, 0], [16, 1]]);
        assert_eq!(pixels[256 + 64..256 + 64 + 5], [[0, 16], [1, 16], [2, 16], [3, 16], [0, 17]]);
        assert_eq!(pixels.last(), Some(&[19, 17]));
    }

    #[test]
    fn the_largest_pictures_do_not_overflow() {
        assert_eq!(tile_order(u32::MAX, u32::MAX).next(), Some([0, 0]));
        let column: Vec<_> = tile_order(1, 20).collect();
        assert_eq!(column.len(), 20);
    }
}
