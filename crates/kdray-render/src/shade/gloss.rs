//! The highlight: microfacets after Trowbridge and Reitz (GGX).

use crate::sampling::tangents;
use crate::surface::Surface;
use glam::{DVec3, Vec3};
use std::f64::consts::{PI, TAU};

/// Smoother surfaces are taken to be as smooth as this where lights without size are concerned,
/// whose highlight would otherwise be too small to see.
const LEAST_ALPHA: f64 = 1e-3;

/// The specular lobe of one surface point: D·G·F / (4·(n·l)·(n·v)) with the GGX distribution D,
/// Smith's height-correlated G and Schlick's F, as in appendix B of glTF 2.0. alpha = roughness².
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gloss {
    normal: DVec3,
    viewer: DVec3,
    alpha: f64,
    /// The reflectance at normal incidence.
    f0: Vec3,
}

impl Gloss {
    pub(crate) fn new(surface: &Surface<'_>) -> Self {
        let f0 = Vec3::from(surface.material.specular).lerp(surface.base_color, surface.metallic);
        let alpha = f64::from(surface.roughness * surface.roughness).max(LEAST_ALPHA);
        Self { normal: surface.normal, viewer: surface.viewer, alpha, f0 }
    }

    /// The lobe's value for light from the unit vector `light`.
    pub(crate) fn value(&self, light: DVec3) -> Vec3 {
        let half = (light + self.viewer).normalize_or(self.normal);
        let (n_l, n_v) = (self.normal.dot(light), self.normal.dot(self.viewer));
        if n_l <= 0.0 || n_v <= 0.0 {
            return Vec3::ZERO;
        }
        let a2 = self.alpha * self.alpha;
        let n_h = self.normal.dot(half).clamp(0.0, 1.0);
        let lambda = n_h * n_h * (a2 - 1.0) + 1.0;
        let distribution = a2 / (PI * lambda * lambda);
        let smith = |a: f64, b: f64| a * (b * b * (1.0 - a2) + a2).sqrt();
        let visibility = 0.5 / (smith(n_l, n_v) + smith(n_v, n_l));
        self.fresnel(self.viewer.dot(half)) * (distribution * visibility) as f32
    }

    /// Schlick's approximation to Fresnel's equations, at the cosine of the angle of incidence. It
    /// rises to 1, but below a reflectance of 2 %, which no real body has, only to 50 times that:
    /// a material of no specular reflection has none at grazing angles either (Lagarde and de
    /// Rousiers, *Moving Frostbite to PBR*, 2014).
    pub(crate) fn fresnel(&self, cos: f64) -> Vec3 {
        let grazing = (1.0 - cos.clamp(0.0, 1.0)).powi(5) as f32;
        let f90 = (self.f0 * 50.0).min(Vec3::ONE);
        self.f0 + (f90 - self.f0).max(Vec3::ZERO) * grazing
    }

    /// A direction to mirror light from, and what it is weighed with. Facets are drawn from those
    /// that the viewer sees (Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 2018),
    /// so that the weight is F·G2/G1 ≤ 1.
    pub(crate) fn sample(&self, [u, v]: [f64; 2]) -> Option<(DVec3, Vec3)> {
        let (x, y) = tangents(self.normal);
        let local =
            DVec3::new(x.dot(self.viewer), y.dot(self.viewer), self.normal.dot(self.viewer));
        let facet = visible_facet(local, self.alpha, u, v);
        let half = x * facet.x + y * facet.y + self.normal * facet.z;
        let light = 2.0 * self.viewer.dot(half) * half - self.viewer;
        let (n_l, n_v) = (self.normal.dot(light), local.z);
        if n_l <= 0.0 || n_v <= 0.0 {
            return None;
        }
        let a2 = self.alpha * self.alpha;
        let smith = |c: f64| (c * c * (1.0 - a2) + a2).sqrt();
        // G2/G1(v) = n_l (n_v + smith(n_v)) / (n_v smith(n_l) + n_l smith(n_v))
        let masking = n_l * (n_v + smith(n_v)) / (n_v * smith(n_l) + n_l * smith(n_v));
        Some((light.normalize(), self.fresnel(self.viewer.dot(half)) * masking as f32))
    }
}

/// The normal of a facet seen from `view`, both in the frame whose z is the surface's normal.
fn visible_facet(view: DVec3, alpha: f64, u: f64, v: f64) -> DVec3 {
    let stretched = DVec3::new(alpha * view.x, alpha * view.y, view.z.max(1e-9)).normalize();
    let (t1, t2) = tangents(stretched);
    let (sin, cos) = (TAU * v).sin_cos();
    let (p1, p2) = (u.sqrt() * cos, u.sqrt() * sin);
    let s = 0.5 * (1.0 + stretched.z);
    // t2 must point down the slope for the warp: any rotation of the frame about the view serves
    // only if the half disk is taken in the plane that holds the normal.
    let down = (DVec3::Z - stretched * stretched.z).normalize_or(t2);
    let across = down.cross(stretched).normalize_or(t1);
    let p2 = (1.0 - s) * (1.0 - p1 * p1).max(0.0).sqrt() + s * p2;
    let p3 = (1.0 - p1 * p1 - p2 * p2).max(0.0).sqrt();
    let n = across * p1 + down * p2 + stretched * p3;
    DVec3::new(alpha * n.x, alpha * n.y, n.z.max(1e-9)).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Sampler, cosine_hemisphere};

    fn gloss(alpha: f64, viewer: DVec3) -> Gloss {
        Gloss { normal: DVec3::Z, viewer: viewer.normalize(), alpha, f0: Vec3::ONE }
    }

    #[test]
    fn sampled_and_integrated_lobes_agree() {
        for (alpha, viewer) in [(0.3, DVec3::new(0.3, 0.1, 1.0)), (0.8, DVec3::new(-1.0, 0.5, 0.4))]
        {
            let gloss = gloss(alpha, viewer);
            let sampler = Sampler::new(5, [0, 0], 0, 1);
            let count = 100_000;
            let (mut integrated, mut sampled) = (0.0, 0.0);
            for i in 0..count {
                let light = cosine_hemisphere(sampler.point(i, count));
                integrated += f64::from(gloss.value(light).x) * PI;
                sampled +=
                    gloss.sample(sampler.fork(1).point(i, count)).map_or(0.0, |s| f64::from(s.1.x));
            }
            let n = f64::from(count);
            assert!((integrated - sampled).abs() / n < 0.01, "{} {}", integrated / n, sampled / n);
            assert!(sampled / n <= 1.0 && sampled / n > 0.5);
        }
    }

    #[test]
    fn the_lobe_is_reciprocal() {
        let (a, b) =
            (DVec3::new(0.4, 0.2, 0.8).normalize(), DVec3::new(-0.1, 0.9, 0.5).normalize());
        let forth = gloss(0.25, a).value(b).x;
        let back = gloss(0.25, b).value(a).x;
        assert!((forth - back).abs() < 1e-6 * forth);
    }
}
