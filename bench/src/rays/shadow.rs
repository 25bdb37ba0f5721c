//! Rays to the point light.

use super::Ray;
use super::surface::Places;

/// The direction is light − origin, so the light is at t = 1; rays end just before it.
const END: f32 = 0.9999;

/// From each place one ray to `light`.
pub(super) fn rays(places: &Places, light: [f64; 3]) -> Vec<Ray> {
    let light = light.map(|x| x as f32);
    let ray = |origin: [f32; 3]| {
        let direction = std::array::from_fn(|axis| light[axis] - origin[axis]);
        Ray { origin, direction, t_max: END }
    };
    places.list.iter().map(|place| ray(place.origin)).collect()
}
