//! The first surfaces on camera rays, whose light rays are answered together.

use super::matt::Matt;
use super::tracer::{Path, Tracer};
use super::whitted::left_before;
use crate::camera_rays::CameraRays;
use crate::surface::{Surface, opacity};
use glam::Vec3;
use kdray::{Hit, Ray};

/// The first surface that a camera ray meets, if no light passes it.
pub(super) struct First<'a> {
    surface: Surface<'a>,
    matt: Option<Matt>,
    /// The share of its light that reaches the camera.
    through: Vec3,
}

impl<'a> Tracer<'a> {
    /// Adds to `radiances` what comes back along each camera ray. The light rays of all surfaces
    /// that they meet are answered together.
    pub(crate) fn radiances(&mut self, rays: &CameraRays, radiances: &mut Vec<[f32; 3]>) {
        let mut firsts = std::mem::take(&mut self.firsts);
        firsts.extend(
            rays.iter().map(|(ray, hit, sampler)| self.first(ray, hit?, &Path::primary(sampler))),
        );
        self.answer(0);
        for ((ray, hit, sampler), first) in rays.iter().zip(firsts.drain(..)) {
            let path = Path::primary(sampler);
            let radiance = match first {
                Some(First { surface, matt, through }) => {
                    through * self.light(&surface, matt.as_ref(), &path)
                }
                None => self.radiance_from(hit, ray, &path),
            };
            radiances.push(radiance.to_array());
        }
        self.light_rays.truncate(0);
        self.firsts = firsts;
    }

    /// The first surface on a camera ray, with its light rays pushed; `None` if there is a lamp
    /// before it, or the ray goes on behind it.
    fn first(&mut self, ray: &Ray, hit: &Hit, path: &Path) -> Option<First<'a>> {
        let t_min = ray.interval.t_min;
        if opacity(self.world, hit) < 1.0 || self.seen_lamp(ray, [t_min, hit.t], path).is_some() {
            return None;
        }
        let surface = Surface::new(self.world, ray, hit);
        let through = left_before(&surface, hit.t - t_min);
        let matt = self.gather(&surface, path);
        Some(First { surface, matt, through })
    }
}
