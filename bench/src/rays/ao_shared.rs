//! Ambient occlusion with one direction a tile: what a renderer asks that samples tile by tile.

use super::Ray;
use super::ao::length;
use super::primary::TILE_RAYS;
use super::surface::Places;
use glam::Vec3;

/// From each place one short ray in the direction of its tile, distributed by the cosine to the normal
/// at the tile's middle place; none where that leads below the surface. And the parents of those rays.
pub(super) fn rays(places: &Places, diagonal: f64) -> (Vec<Ray>, Vec<u32>) {
    let directions = places.cosine_directions(3);
    let t_max = length(diagonal);
    let tile = |index: usize| places.parents[index] / TILE_RAYS;
    let mut sets = (Vec::new(), Vec::new());
    let mut first = 0;
    while first < places.list.len() {
        let count = places.parents[first..].partition_point(|it| it / TILE_RAYS == tile(first));
        let direction = directions[first + count / 2];
        for index in first..first + count {
            let place = &places.list[index];
            if place.facing.dot(Vec3::from(direction).as_dvec3()) > 0.0 {
                sets.0.push(Ray { origin: place.origin, direction, t_max });
                sets.1.push(places.parents[index]);
            }
        }
        first += count;
    }
    sets
}
