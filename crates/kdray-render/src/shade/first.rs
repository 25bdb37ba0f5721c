//! The first surfaces on camera rays, whose light rays are answered together.

use super::matt::Matt;
use super::met::Met;
use super::tracer::{Path, Tracer};
use crate::camera_rays::CameraRays;
use crate::surface::Surface;
use glam::Vec3;
use kdray::{Hit, Ray};

/// The first surface that a camera ray meets, if no light passes it.
pub(super) struct First<'a> {
    surface: Surface<'a>,
    matt: Option<Matt>,
    /// The share of its light that reaches the camera.
    left: Vec3,
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
                Some(First { surface, matt, left }) => {
                    left * self.light(&surface, matt.as_ref(), &path)
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
        if self.goes_on_behind(hit) {
            return None;
        }
        let Met::Surface { surface, left } = self.meet(ray, ray.interval.t_min, hit, path) else {
            return None;
        };
        let matt = self.gather(&surface, path);
        Some(First { surface, matt, left })
    }
}
