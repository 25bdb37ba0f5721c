//! Rays through the pixels of a square picture.

use super::Ray;
use kdray_render::View;

/// Pixels across and down of a tile; see [`pixel`].
const TILE: u32 = 16;

/// One ray through the middle of each pixel, in the order of [`pixel`].
pub(super) fn rays(view: &View, resolution: u32) -> Vec<Ray> {
    let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(resolution);
    let ray = |index| {
        let [x, y] = pixel(index, resolution);
        let ray = view.ray(middle(x), middle(y));
        let [origin, direction] = [ray.origin, ray.direction].map(|v| v.map(|x| x as f32));
        Ray { origin, direction, t_max: f32::INFINITY }
    };
    (0..resolution * resolution).map(ray).collect()
}

/// The pixel of the ray of that index: tiles of 16 x 16 pixels row by row; in a tile four blocks of
/// 8 x 8; in a block eight groups of 4 x 2. So eight consecutive rays are a packet as square as
/// can be, and so are 64 and 256. `resolution` is a multiple of 16.
pub(crate) fn pixel(index: u32, resolution: u32) -> [u32; 2] {
    let tile = index / (TILE * TILE);
    let (block, group, ray) = (index / 64 % 4, index / 8 % 8, index % 8);
    let tiles = resolution / TILE;
    let x = tile % tiles * TILE + block % 2 * 8 + group % 2 * 4 + ray % 4;
    let y = tile / tiles * TILE + block / 2 * 8 + group / 2 * 2 + ray / 4;
    [x, y]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_has_one_ray() {
        let mut pixels: Vec<[u32; 2]> = (0..48 * 48).map(|i| pixel(i, 48)).collect();
        pixels.sort_unstable();
        let all = (0..48).flat_map(|x| (0..48).map(move |y| [x, y]));
        assert!(pixels.into_iter().eq(all));
    }

    #[test]
    fn consecutive_rays_are_compact() {
        for (count, across, down) in [(8, 4, 2), (64, 8, 8), (256, 16, 16)] {
            for first in (0..48 * 48).step_by(count) {
                let pixels = || (first..first + count).map(|i| pixel(i as u32, 48));
                let width = pixels().map(|p| p[0]).max().zip(pixels().map(|p| p[0]).min());
                let height = pixels().map(|p| p[1]).max().zip(pixels().map(|p| p[1]).min());
                assert_eq!(width.map(|(a, b)| a - b + 1), Some(across));
                assert_eq!(height.map(|(a, b)| a - b + 1), Some(down));
            }
        }
    }
}
