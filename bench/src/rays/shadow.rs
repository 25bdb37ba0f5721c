//! Rays to the point light.

use super::Ray;
use super::surface::Places;

/// The direction is light − origin, so the light is at t = 1; rays end just before it.
const END: f32 = 0.9999;

/// From each place one ray to `light`. Light and origins are rounded to a grid so coarse that no
/// difference of two of its points is rounded in f32: so all rays meet in one point, exactly.
pub(super) fn rays(places: &Places, light: [f64; 3]) -> Vec<Ray> {
    let coordinates = places.list.iter().flat_map(|place| place.origin.map(f64::from));
    let farthest = coordinates.chain(light).fold(0.0, |most: f64, x| most.max(x.abs()));
    let step = (farthest.log2().ceil() - f64::from(f32::MANTISSA_DIGITS - 2)).exp2();
    let on_grid = |x: f64| ((x / step).round() * step) as f32;
    let light = light.map(on_grid);
    let ray = |origin: [f32; 3]| {
        let origin = origin.map(|x| on_grid(f64::from(x)));
        let direction = std::array::from_fn(|axis| light[axis] - origin[axis]);
        Ray { origin, direction, t_max: END }
    };
    places.list.iter().map(|place| ray(place.origin)).collect()
}
