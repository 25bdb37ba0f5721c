//! Neighbouring pixels, taken together.

/// Pixels across and down of a tile, the rays through which are the largest packet.
pub(crate) const TILE: usize = 16;

/// The pixel of a tile at each place: four blocks of 8 x 8, in a block eight groups of 4 x 2. So eight
/// pixels that follow each other are as square as can be, and so are 64 and 256.
pub(crate) fn pixels() -> impl Iterator<Item = [usize; 2]> {
    (0..TILE * TILE).map(|index| {
        let (block, group, pixel) = (index / 64, index / 8 % 8, index % 8);
        let x = block % 2 * 8 + group % 2 * 4 + pixel % 4;
        let y = block / 2 * 8 + group / 2 * 2 + pixel / 4;
        [x, y]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_of_a_tile_comes_once() {
        let mut found: Vec<[usize; 2]> = pixels().collect();
        found.sort_unstable();
        assert!(found.into_iter().eq((0..TILE).flat_map(|x| (0..TILE).map(move |y| [x, y]))));
    }

    #[test]
    fn pixels_that_follow_each_other_are_compact() {
        let pixels: Vec<[usize; 2]> = pixels().collect();
        for (count, extent) in [(8, [4, 2]), (64, [8, 8]), (256, [16, 16])] {
            for group in pixels.chunks(count) {
                for (k, extent) in extent.into_iter().enumerate() {
                    let values = || group.iter().map(|pixel| pixel[k]);
                    assert_eq!(
                        values().max().zip(values().min()).map(|(a, b)| a - b + 1),
                        Some(extent)
                    );
                }
            }
        }
    }
}
