//! Ambient occlusion: short rays that ask whether something is near.

use super::Ray;
use super::surface::Places;

/// How long the rays are, by the scene's diagonal.
const LENGTH: f64 = 0.1;

/// From each place one short ray, distributed by the cosine to the normal.
pub(super) fn rays(places: &Places, diagonal: f64) -> Vec<Ray> {
    let directions = places.cosine_directions(2);
    let t_max = length(diagonal);
    let ends = places.list.iter().zip(directions);
    ends.map(|(place, direction)| Ray { origin: place.origin, direction, t_max }).collect()
}

/// How long the rays are in a scene of this diagonal.
pub(super) fn length(diagonal: f64) -> f32 {
    (LENGTH * diagonal) as f32
}
