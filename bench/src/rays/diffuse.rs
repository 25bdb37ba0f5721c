//! One bounce of light off a matt surface.

use super::Ray;
use super::surface::Places;

/// From each place one ray without end, distributed by the cosine to the normal.
pub(super) fn rays(places: &Places) -> Vec<Ray> {
    let directions = places.cosine_directions(1);
    let ends = places.list.iter().zip(directions);
    ends.map(|(place, direction)| Ray { origin: place.origin, direction, t_max: f32::INFINITY })
        .collect()
}
