//! Backward ray tracing: Whitted, "An Improved Illumination Model for Shaded Display" (1980).

use super::dielectric::{Boundary, attenuation};
use super::gloss::Gloss;
use crate::light::Lamp;
use crate::options::RenderOptions;
use crate::sampling::Sampler;
use crate::surface::{Surface, opacity};
use crate::world::World;
use glam::{DVec3, Vec3};
use kdray::{Hit, Ray};
use std::cell::Cell;

/// Contributions to a pixel below this share are not followed (Hall and Greenberg's adaptive
/// depth control, 1983): half of what an 8-bit PNG can show in the shadows.
const NEGLIGIBLE: f32 = 1.0 / 1024.0;

/// What the random numbers of a bounce are for.
const GLOSS: u32 = 1;
const MIRROR: u32 = 2;
const REFRACTION: u32 = 3;

/// Follows rays through one world. Each thread has its own.
pub(crate) struct Tracer<'a> {
    pub(crate) world: &'a World,
    pub(crate) lamps: &'a [Lamp],
    pub(crate) options: &'a RenderOptions,
    pub(crate) occlusion_distance: f64,
    rays: Cell<u64>,
}

/// How a ray came about.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Path {
    /// How often it was mirrored or refracted.
    pub(crate) bounces: u32,
    /// The most that its light adds to the pixel, as a share.
    pub(crate) weight: f32,
    /// Whether it sees the lamps' surfaces: not where their highlight is computed otherwise.
    pub(crate) sees_lamps: bool,
    /// Its random numbers.
    pub(crate) sampler: Sampler,
}

impl Path {
    /// The path of a camera ray.
    pub(crate) fn primary(sampler: Sampler) -> Self {
        Self { bounces: 0, weight: 1.0, sees_lamps: true, sampler }
    }

    fn bounced(&self, purpose: u32, weight: Vec3, sees_lamps: bool) -> Self {
        let sampler = self.sampler.fork(purpose);
        let weight = self.weight * weight.max_element();
        Self { bounces: self.bounces + 1, weight, sees_lamps, sampler }
    }
}

impl<'a> Tracer<'a> {
    pub(crate) fn new(
        world: &'a World,
        lamps: &'a [Lamp],
        options: &'a RenderOptions,
        occlusion_distance: f64,
    ) -> Self {
        Self { world, lamps, options, occlusion_distance, rays: Cell::new(0) }
    }

    /// How many rays were shot.
    pub(crate) fn rays(&self) -> u64 {
        self.rays.get()
    }

    pub(crate) fn count_ray(&self) {
        self.rays.set(self.rays.get() + 1);
    }

    /// Radiance that is not worth a shadow ray.
    pub(crate) fn negligible(&self) -> f32 {
        NEGLIGIBLE / 16.0 / self.options.exposure.max(f32::MIN_POSITIVE)
    }

    /// The radiance that comes back along `ray`, whose direction has unit length.
    pub(crate) fn radiance(&self, ray: Ray, path: &Path) -> Vec3 {
        self.count_ray();
        let scene = self.world.scene();
        match scene.closest_hit(&ray) {
            // Behind a cut-out or a veil the ray goes on. All that it crosses is asked for, in
            // order, since another surface may lie at the very same t.
            Some(hit) if opacity(self.world, &hit) < 1.0 => {
                let rest = ray.with_interval(hit.t, ray.interval.t_max);
                self.radiance_of(scene.all_hits(&rest), &ray, path)
            }
            first => self.radiance_of(first.into_iter(), &ray, path),
        }
    }

    /// The radiance that comes back along `ray` from its `hits`, which are in order.
    fn radiance_of(&self, hits: impl Iterator<Item = Hit>, ray: &Ray, path: &Path) -> Vec3 {
        let (mut sum, mut through) = (Vec3::ZERO, Vec3::ONE);
        let mut t_before = ray.interval.t_min;
        for hit in hits {
            if let Some(glow) = self.seen_lamp(ray, [t_before, hit.t], path) {
                return sum + through * glow;
            }
            let surface = Surface::new(self.world, ray, &hit);
            if surface.opacity > 0.0 {
                if !surface.outside {
                    through *= attenuation(surface.material, hit.t - t_before);
                }
                sum += through * surface.opacity * self.shade(&surface, path);
            }
            through *= 1.0 - surface.opacity;
            if through.max_element() * path.weight < NEGLIGIBLE {
                return sum;
            }
            t_before = hit.t;
        }
        let behind = self.seen_lamp(ray, [t_before, f64::INFINITY], path);
        let sky = || self.options.background.radiance(ray.direction.into());
        sum + through * behind.unwrap_or_else(sky)
    }

    /// The radiance of a lamp's surface that the ray meets between two places.
    fn seen_lamp(&self, ray: &Ray, [from, to]: [f64; 2], path: &Path) -> Option<Vec3> {
        if !path.sees_lamps {
            return None;
        }
        let seen = |lamp: &Lamp| lamp.seen(ray.origin.into(), ray.direction.into());
        let between = |&(t, _): &(f64, Vec3)| from < t && t < to;
        let nearest = |a: &(f64, Vec3), b: &(f64, Vec3)| a.0.total_cmp(&b.0);
        self.lamps.iter().filter_map(seen).filter(between).min_by(nearest).map(|(_, glow)| glow)
    }

    /// The light that an opaque point of a surface sends to the viewer: its emission, what it
    /// reflects of lamps and ambient light, and what it mirrors and refracts.
    fn shade(&self, surface: &Surface<'_>, path: &Path) -> Vec3 {
        let material = surface.material;
        if material.unlit {
            return surface.base_color;
        }
        let mirror = Vec3::from(material.mirror);
        let transmission = material.transmission * (1.0 - surface.metallic);
        let matt = (Vec3::ONE - mirror).max(Vec3::ZERO) * (1.0 - transmission);
        let mut light = surface.emission;
        if matt.max_element() > 0.0 {
            light += self.matt(surface, matt, path);
        }
        if mirror.max_element() > 0.0 {
            let direction =
                2.0 * surface.viewer.dot(surface.normal) * surface.normal - surface.viewer;
            light += self.bounce(surface, direction, mirror, &path.bounced(MIRROR, mirror, true));
        }
        if transmission > 0.0 {
            light += self.glass(surface, transmission, path);
        }
        light
    }

    /// Diffuse reflection and the highlight, in the share `matt`.
    fn matt(&self, surface: &Surface<'_>, matt: Vec3, path: &Path) -> Vec3 {
        let diffuse = matt * surface.base_color * (1.0 - surface.metallic);
        let gloss = Gloss::new(surface);
        let mut light = self.direct(surface, diffuse, &gloss, path);

        // How much of the surroundings is mirrored by a ray rather than taken for ambient light:
        // all of it by metals, and the less by dielectrics the rougher they are.
        let smooth = 1.0 - surface.roughness;
        let traced = smooth * smooth * (1.0 - surface.metallic) + surface.metallic;
        let fresnel = matt * gloss.fresnel(surface.viewer.dot(surface.normal));
        let mirrored = (fresnel * traced).max_element() * path.weight > 0.01;
        if mirrored
            && let Some((direction, weight)) = gloss.sample(path.sampler.fork(GLOSS).point(0, 1))
        {
            let weight = matt * weight * traced;
            light += self.bounce(surface, direction, weight, &path.bounced(GLOSS, weight, false));
        }
        let untraced = if mirrored { fresnel * (1.0 - traced) } else { fresnel };
        let ambient =
            Vec3::from(self.options.ambient) * (diffuse + untraced * (1.0 - surface.metallic));
        light + ambient * self.ambient_reaching(surface, ambient, path)
    }

    fn ambient_reaching(&self, surface: &Surface<'_>, ambient: Vec3, path: &Path) -> Vec3 {
        let count = self.options.ambient_rays.min(if path.bounces == 0 { u32::MAX } else { 1 });
        if count == 0 || ambient.max_element() * path.weight < NEGLIGIBLE {
            return Vec3::ONE;
        }
        self.ambient_share(surface, count, path.sampler)
    }

    /// What the boundary of a clear body mirrors and lets through.
    fn glass(&self, surface: &Surface<'_>, transmission: f32, path: &Path) -> Vec3 {
        let ior = f64::from(surface.material.ior.max(1e-3));
        let eta = if surface.outside { ior } else { 1.0 / ior };
        let boundary = Boundary::new(surface.viewer, surface.normal, eta);
        let reflectance = boundary.reflectance as f32;
        let mirrored = Vec3::splat(transmission * reflectance);
        let mut light = self.bounce(
            surface,
            boundary.reflected,
            mirrored,
            &path.bounced(MIRROR, mirrored, true),
        );
        if let Some(direction) = boundary.refracted {
            let passed = surface.base_color * transmission * (1.0 - reflectance);
            let path = path.bounced(REFRACTION, passed, true);
            light += self.pass(surface, direction, passed, &path);
        }
        light
    }

    /// `weight` times what comes from `direction` on the viewer's side of the surface.
    fn bounce(&self, surface: &Surface<'_>, direction: DVec3, weight: Vec3, path: &Path) -> Vec3 {
        self.follow(surface, kept_on_side(direction, surface.at.facing), weight, path)
    }

    /// `weight` times what comes from `direction` behind the surface.
    fn pass(&self, surface: &Surface<'_>, direction: DVec3, weight: Vec3, path: &Path) -> Vec3 {
        self.follow(surface, kept_on_side(direction, -surface.at.facing), weight, path)
    }

    fn follow(&self, surface: &Surface<'_>, direction: DVec3, weight: Vec3, path: &Path) -> Vec3 {
        if path.weight < NEGLIGIBLE {
            return Vec3::ZERO;
        }
        if path.bounces > self.options.max_bounces {
            return weight * Vec3::from(self.options.ambient);
        }
        weight * self.radiance(surface.at.ray_along(direction), path)
    }
}

/// `direction`, or if a smooth normal has led it to the wrong side of the triangle, the direction
/// nearest to it that is just on the side that `facing` points to.
fn kept_on_side(direction: DVec3, facing: DVec3) -> DVec3 {
    const JUST: f64 = 1e-3;
    let height = direction.dot(facing);
    if height >= JUST {
        return direction.normalize();
    }
    (direction + (JUST - height) * facing).normalize_or(facing)
}
