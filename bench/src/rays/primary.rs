//! Rays through the pixels of a square picture.

use super::Ray;
use kdray::geometry::{TILE, tile_order};
use kdray_render::View;

/// Rays through a tile.
pub(super) const TILE_RAYS: u32 = TILE * TILE;

/// One ray through the middle of each pixel, in the order of [`tile_order`].
pub(super) fn rays(view: &View, resolution: u32) -> Vec<Ray> {
    let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(resolution);
    let ray = |[x, y]: [u32; 2]| {
        let ray = view.ray(middle(x), middle(y));
        let [origin, direction] = [ray.origin, ray.direction].map(|v| v.map(|x| x as f32));
        Ray { origin, direction, t_max: f32::INFINITY }
    };
    tile_order(resolution, resolution).map(ray).collect()
}
