//! Lights: what is wrong with one, and lights for scenes without any.

use glam::DVec3;
use kdray::Aabb;
use kdray_scene::{Camera, Light};
use std::f64::consts::PI;
use thiserror::Error;

/// Why a light cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum LightError {
    /// A number is infinite or NaN.
    #[error("light {0} has a number that is not finite")]
    NotFinite(usize),
    /// A direction or an edge has no length.
    #[error("light {0} has a direction or an edge of length zero")]
    ZeroDirection(usize),
}

/// A point light at `position` that suits the scene: a white surface that faces it from the
/// distance of the middle of `bounds` (at least a quarter of the diagonal) appears as white.
///
/// In formulas: the intensity is π·r², so that the irradiance I/r² is π and a Lambertian surface
/// of albedo ρ has radiance ρ/π · π = ρ.
pub fn point_light_for(bounds: &Aabb<3>, position: [f64; 3]) -> Light {
    let (center, diagonal) = if bounds.is_empty() {
        (DVec3::ZERO, 1.0)
    } else {
        (DVec3::from(bounds.center()), bounds.diagonal())
    };
    let distance = (DVec3::from(position) - center).length().max(diagonal / 4.0);
    let intensity = (PI * distance * distance).clamp(f64::from(f32::MIN_POSITIVE), 1e38);
    Light::Point { position, intensity: [intensity as f32; 3], cone: None }
}

/// The light of a scene that has none: parallel light from over the camera's left shoulder.
pub fn default_lights(camera: &Camera) -> Vec<Light> {
    let forward = (DVec3::from(camera.look_at) - DVec3::from(camera.eye)).normalize_or(-DVec3::Z);
    let right = forward.cross(camera.up.into()).normalize_or(DVec3::X);
    let up = right.cross(forward);
    let direction = forward + 0.5 * right - 0.8 * up;
    vec![Light::Directional { direction: direction.into(), irradiance: [2.6; 3] }]
}
