//! The boundary of clear bodies: Snell's law, Fresnel's equations, and Beer's law within.

use glam::{DVec3, Vec3};
use kdray_scene::Material;

/// Directions of light at a smooth boundary, and the share that is mirrored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Boundary {
    /// The mirrored direction.
    pub(crate) reflected: DVec3,
    /// The direction behind the boundary by Snell's law; `None` for total reflection.
    pub(crate) refracted: Option<DVec3>,
    /// The mirrored share of unpolarised light; 1 for total reflection.
    pub(crate) reflectance: f64,
}

impl Boundary {
    /// Where light goes whose way back is the unit vector `viewer`, at a boundary with the unit
    /// normal `normal` on the viewer's side. `eta` is the index of refraction behind the boundary
    /// divided by that before it.
    ///
    /// With cos i the cosine on the viewer's side, sin t = sin i / eta, and the refracted direction
    /// is −v/eta + (cos i/eta − cos t)·n. Fresnel's amplitudes are r_s = (cos i − eta·cos t) /
    /// (cos i + eta·cos t) and r_p = (eta·cos i − cos t) / (eta·cos i + cos t); the reflectance is
    /// the mean of their squares (Born and Wolf, *Principles of Optics*, section 1.5).
    pub(crate) fn new(viewer: DVec3, normal: DVec3, eta: f64) -> Self {
        let cos_i = viewer.dot(normal).clamp(0.0, 1.0);
        let reflected = (2.0 * cos_i * normal - viewer).normalize();
        let sin2_t = (1.0 - cos_i * cos_i) / (eta * eta);
        if sin2_t >= 1.0 {
            return Self { reflected, refracted: None, reflectance: 1.0 };
        }
        let cos_t = (1.0 - sin2_t).sqrt();
        let r_s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
        let r_p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
        let refracted = (-viewer / eta + (cos_i / eta - cos_t) * normal).normalize();
        let reflectance = 0.5 * (r_s * r_s + r_p * r_p);
        Self { reflected, refracted: Some(refracted), reflectance }
    }
}

/// What is left of white light after `distance` in the material's body: by Beer and Lambert it
/// falls exponentially, to `attenuation_color` at `attenuation_distance`.
pub(crate) fn attenuation(material: &Material, distance: f64) -> Vec3 {
    let lengths = distance / f64::from(material.attenuation_distance);
    if material.transmission == 0.0 || lengths.is_nan() || lengths <= 0.0 {
        return Vec3::ONE;
    }
    let color = Vec3::from(material.attenuation_color).clamp(Vec3::ZERO, Vec3::ONE);
    Vec3::from(color.to_array().map(|c| f64::from(c).powf(lengths) as f32))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_6;

    fn from_angle(angle: f64) -> DVec3 {
        DVec3::new(angle.sin(), 0.0, angle.cos())
    }

    #[test]
    fn at_normal_incidence_fresnel_gives_four_percent_of_glass() {
        let boundary = Boundary::new(DVec3::Z, DVec3::Z, 1.5);
        assert!((boundary.reflectance - 0.04).abs() < 1e-12);
        assert_eq!(boundary.refracted, Some(-DVec3::Z));
        assert_eq!(boundary.reflected, DVec3::Z);
    }

    #[test]
    fn thirty_degrees_into_glass_become_nineteen() {
        let boundary = Boundary::new(from_angle(FRAC_PI_6), DVec3::Z, 1.5);
        let t = boundary.refracted.unwrap();
        // sin t = 0.5 / 1.5; the direction keeps to the plane of incidence.
        assert!((t.x + 1.0 / 3.0).abs() < 1e-12 && t.y == 0.0 && t.z < 0.0);
        assert!(boundary.reflected.distance(from_angle(-FRAC_PI_6)) < 1e-12);
        let back = Boundary::new(t, -DVec3::Z, 1.0 / 1.5);
        assert!(back.refracted.unwrap().distance(from_angle(FRAC_PI_6)) < 1e-12);
        assert!((back.reflectance - boundary.reflectance).abs() < 1e-12, "Stokes' relation");
    }

    #[test]
    fn beyond_the_critical_angle_all_is_reflected() {
        let critical = (1.0_f64 / 1.5).asin();
        let below = Boundary::new(from_angle(critical - 1e-6), DVec3::Z, 1.0 / 1.5);
        let above = Boundary::new(from_angle(critical + 1e-6), DVec3::Z, 1.0 / 1.5);
        assert!(below.refracted.is_some() && below.reflectance < 1.0);
        assert_eq!((above.refracted, above.reflectance), (None, 1.0));
    }

    #[test]
    fn at_brewsters_angle_only_one_polarisation_is_reflected() {
        let boundary = Boundary::new(from_angle(1.5_f64.atan()), DVec3::Z, 1.5);
        let r_s: f64 = (1.0 - 2.25) / (1.0 + 2.25);
        assert!((boundary.reflectance - 0.5 * r_s * r_s).abs() < 1e-12);
    }

    #[test]
    fn attenuation_multiplies_over_distance() {
        let material = Material {
            transmission: 1.0,
            attenuation_color: [0.5, 0.25, 1.0],
            attenuation_distance: 2.0,
            ..Material::default()
        };
        assert_eq!(attenuation(&material, 2.0), Vec3::new(0.5, 0.25, 1.0));
        assert!(attenuation(&material, 4.0).distance(Vec3::new(0.25, 0.0625, 1.0)) < 1e-6);
        assert_eq!(
            attenuation(&Material { transmission: 1.0, ..Material::default() }, 9.0),
            Vec3::ONE
        );
    }
}
