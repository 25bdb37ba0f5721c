//! Lights: what arrives from one, and lights for scenes without any.

use crate::camera::direction;
use glam::{DVec3, Vec3};
use kdray::Aabb;
use kdray::geometry::Common;
use kdray_scene::{Camera, Light};
use std::f64::consts::PI;
use thiserror::Error;

/// Why a light cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum LightError {
    /// A number is infinite or NaN.
    #[error("light {0} has a number that is not finite; give finite ones")]
    NotFinite(usize),
    /// A direction has no length.
    #[error("light {0} has a direction of length zero; give one of any other length")]
    ZeroDirection(usize),
}

/// A point light at `position` that suits the scene: a white surface that faces it from the
/// distance of the middle of `bounds` (at least an eighth of the diagonal) appears as white.
///
/// In formulas: the intensity is π·r², so that the irradiance I/r² is π and a Lambertian surface
/// of albedo ρ has radiance ρ/π · π = ρ.
pub fn point_light_for(bounds: &Aabb<3>, position: [f64; 3]) -> Light {
    let (center, diagonal) = if bounds.is_empty() {
        (DVec3::ZERO, 1.0)
    } else {
        (DVec3::from(bounds.center()), bounds.diagonal())
    };
    let distance = (DVec3::from(position) - center).length().max(diagonal / 8.0);
    let intensity = (PI * distance * distance).clamp(f64::from(f32::MIN_POSITIVE), 1e38);
    Light::Point { position, intensity: [intensity as f32; 3], cone: None }
}

/// The light of a scene that has none: a weak lamp at the camera, so that no interior is dark, and
/// last the sun from over the camera's left shoulder. The lamp makes a white surface gray (0.3)
/// that faces it from a third of the diagonal of `bounds`.
pub fn default_lights(camera: &Camera, bounds: &Aabb<3>) -> Vec<Light> {
    let forward = (DVec3::from(camera.look_at) - DVec3::from(camera.eye)).normalize_or(-DVec3::Z);
    let up = direction(camera.up).unwrap_or(DVec3::Y);
    let right = forward.cross(up).normalize_or(DVec3::X);
    let up = right.cross(forward);
    let direction = forward + 0.25 * right - 0.5 * up;
    let reach = if bounds.is_empty() { 1.0 } else { bounds.diagonal() / 3.0 };
    let intensity = (0.3 * PI * reach * reach).min(1e38) as f32;
    vec![
        Light::Point { position: camera.eye, intensity: [intensity; 3], cone: None },
        Light::Directional { direction: direction.into(), irradiance: [2.2; 3] },
    ]
}

/// A light made ready for shading.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Lamp {
    Point { position: DVec3, intensity: Vec3, cone: Option<Spot> },
    Directional { to_light: DVec3, irradiance: Vec3 },
    Rectangle(Panel),
}

/// A cone of light: what arrives at the angle a from the middle is multiplied by
/// clamp(cos a · scale + offset)², as KHR_lights_punctual recommends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    direction: DVec3,
    scale: f64,
    offset: f64,
}

/// A parallelogram that shines on one side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Panel {
    corner: DVec3,
    edge_u: DVec3,
    edge_v: DVec3,
    /// The unit normal of the side that shines.
    normal: DVec3,
    area: f64,
    radiance: Vec3,
}

/// Light that would arrive at a point if nothing were in its way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Arrival {
    /// Where it comes from.
    pub(crate) from: Source,
    /// Irradiance on a surface that faces it.
    pub(crate) irradiance: Vec3,
}

/// Where light comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Source {
    /// A point.
    Point(DVec3),
    /// Infinitely far, against this unit vector.
    Far(DVec3),
}

impl Lamp {
    /// The lamps of `lights`.
    pub(crate) fn all(lights: &[Light]) -> Result<Vec<Self>, LightError> {
        lights.iter().enumerate().map(|(index, light)| Self::new(light, index)).collect()
    }

    fn new(light: &Light, index: usize) -> Result<Self, LightError> {
        let finite =
            |v: DVec3| if v.is_finite() { Ok(v) } else { Err(LightError::NotFinite(index)) };
        let unit =
            |v: [f64; 3]| finite(v.into())?.try_normalize().ok_or(LightError::ZeroDirection(index));
        let color = |c: [f32; 3]| finite(Vec3::from(c).as_dvec3()).map(|_| Vec3::from(c));
        Ok(match *light {
            Light::Point { position, intensity, cone } => {
                let cone = match cone {
                    None => None,
                    Some(cone) => {
                        let direction = unit(cone.direction)?;
                        let [inner, outer] =
                            [cone.inner_angle, cone.outer_angle].map(|a| f64::from(a).cos());
                        let scale = 1.0 / (inner - outer).max(1e-3);
                        finite(DVec3::splat(scale * outer))?;
                        Some(Spot { direction, scale, offset: -outer * scale })
                    }
                };
                let position = finite(position.into())?;
                Self::Point { position, intensity: color(intensity)?, cone }
            }
            Light::Directional { direction, irradiance } => {
                Self::Directional { to_light: -unit(direction)?, irradiance: color(irradiance)? }
            }
            Light::Rectangle { corner, edge_u, edge_v, radiance } => {
                let [corner, edge_u, edge_v] = [corner, edge_u, edge_v].map(DVec3::from);
                finite(corner + edge_u + edge_v)?;
                let across = edge_u.cross(edge_v);
                Self::Rectangle(Panel {
                    corner,
                    edge_u,
                    edge_v,
                    normal: across.normalize_or_zero(),
                    area: across.length(),
                    radiance: color(radiance)?,
                })
            }
        })
    }

    /// Whether its light comes from one point only, so that one shadow ray tells all.
    pub(crate) fn is_sharp(&self) -> bool {
        self.common().is_some()
    }

    /// What all rays to the lamp share, if that is anything.
    pub(crate) fn common(&self) -> Option<Common> {
        match self {
            Self::Point { position, .. } => Some(Common::Target(position.to_array())),
            Self::Directional { to_light, .. } => Some(Common::Direction(to_light.to_array())),
            Self::Rectangle(_) => None,
        }
    }

    /// What arrives at `point`; from a rectangle, at its point (u, v) as if all came from there.
    pub(crate) fn arrival(&self, point: DVec3, [u, v]: [f64; 2]) -> Arrival {
        match self {
            Self::Point { position, intensity, cone } => {
                let away = point - *position;
                let share = cone.map_or(1.0, |spot| spot.share(away));
                let irradiance = *intensity * (share / away.length_squared()) as f32;
                Arrival { from: Source::Point(*position), irradiance }
            }
            Self::Directional { to_light, irradiance } => {
                Arrival { from: Source::Far(*to_light), irradiance: *irradiance }
            }
            Self::Rectangle(panel) => {
                let position = panel.corner + panel.edge_u * u + panel.edge_v * v;
                let away = point - position;
                let cos = away.dot(panel.normal).max(0.0) / away.length();
                let share = cos * panel.area / away.length_squared();
                let irradiance = panel.radiance * share as f32;
                Arrival { from: Source::Point(position), irradiance }
            }
        }
    }
}

impl Spot {
    fn share(&self, away: DVec3) -> f64 {
        let cos = away.normalize_or_zero().dot(self.direction);
        (cos * self.scale + self.offset).clamp(0.0, 1.0).powi(2)
    }
}

impl Panel {
    /// The distance at which the ray from `origin` along the unit vector `direction` meets the
    /// shining side, and the radiance there.
    pub(crate) fn seen(&self, origin: DVec3, direction: DVec3) -> Option<(f64, Vec3)> {
        let against = direction.dot(self.normal);
        if against >= 0.0 {
            return None;
        }
        let to_corner = self.corner - origin;
        let t = to_corner.dot(self.normal) / against;
        let inside = direction * t - to_corner;
        // The dual edges give the coordinates along edge_u and edge_v.
        let u = inside.cross(self.edge_v).dot(self.normal) / self.area;
        let v = self.edge_u.cross(inside).dot(self.normal) / self.area;
        let hit = t > 0.0 && (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v);
        hit.then_some((t, self.radiance))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kdray_scene::Cone;

    #[test]
    fn a_panel_is_seen_from_its_front_only() {
        let light = Light::Rectangle {
            corner: [1.0, 5.0, 1.0],
            edge_u: [2.0, 0.0, 0.0],
            edge_v: [1.0, 0.0, 3.0],
            radiance: [2.0; 3],
        };
        let Lamp::Rectangle(panel) = Lamp::new(&light, 0).unwrap() else { panic!() };
        let below = DVec3::new(2.0, 1.0, 1.5);
        assert_eq!(panel.seen(below, DVec3::Y), Some((4.0, Vec3::splat(2.0))));
        assert_eq!(
            panel.seen(DVec3::new(1.1, 1.0, 3.0), DVec3::Y),
            None,
            "beside the slanted edge"
        );
        assert_eq!(panel.seen(below + 9.0 * DVec3::Y, -DVec3::Y), None, "from behind");
        assert_eq!(panel.seen(below, -DVec3::Y), None);
    }

    #[test]
    fn a_spot_is_bright_inside_and_dark_outside() {
        let cone = Cone { direction: [0.0, -2.0, 0.0], inner_angle: 0.3, outer_angle: 0.6 };
        let light = Light::Point { position: [0.0; 3], intensity: [4.0; 3], cone: Some(cone) };
        let lamp = Lamp::new(&light, 0).unwrap();
        let at = |angle: f64| {
            let point = 2.0 * DVec3::new(angle.sin(), -angle.cos(), 0.0);
            lamp.arrival(point, [0.0; 2]).irradiance.x
        };
        assert!((at(0.0) - 1.0).abs() < 1e-6 && (at(0.29) - 1.0).abs() < 1e-6);
        assert!(at(0.45) > 0.01 && at(0.45) < 0.99);
        assert_eq!(at(0.61), 0.0);
    }

    #[test]
    fn bad_lights_are_named() {
        let direction = [0.0; 3];
        let dark = Light::Directional { direction, irradiance: [1.0; 3] };
        let sound = point_light_for(&Aabb::EMPTY, [1.0; 3]);
        let found = Lamp::all(&[sound, dark]).err();
        assert_eq!(found, Some(LightError::ZeroDirection(1)));
        let wild = Light::Directional { direction: [1.0; 3], irradiance: [f32::NAN; 3] };
        assert_eq!(Lamp::all(&[wild]).err(), Some(LightError::NotFinite(0)));
    }

    #[test]
    fn the_fitting_point_light_makes_white_white() {
        let bounds = Aabb { min: [-10.0, 0.0, 0.0], max: [10.0, 0.0, 0.0] };
        let lamp = Lamp::new(&point_light_for(&bounds, [0.0, 30.0, 0.0]), 0).unwrap();
        let arrival = lamp.arrival(DVec3::ZERO, [0.0; 2]);
        assert!((arrival.irradiance.x - std::f32::consts::PI).abs() < 1e-5);
    }
}
