//! What a surface reflects in all directions: diffuse light, the highlight, ambient light.

use super::direct::Surroundings;
use super::gloss::Gloss;
use super::tracer::{NEGLIGIBLE, Path, Tracer};
use crate::surface::Surface;
use glam::Vec3;
use std::ops::Range;

/// What the random numbers of the glossy ray are for.
const GLOSS: u32 = 1;

/// The matt part of a point of a surface, and the rays that tell what light reaches it.
pub(crate) struct Matt {
    /// What is neither mirrored perfectly nor let through.
    share: Vec3,
    gloss: Gloss,
    /// How much of the surroundings is mirrored by a ray rather than taken for ambient light;
    /// `None` if that is not worth a ray.
    traced: Option<f32>,
    /// The ambient light that is reflected where nothing is near.
    ambient: Vec3,
    to_lamps: Range<usize>,
    /// `None` if nothing is asked about them: all ambient light arrives.
    to_surroundings: Option<Surroundings>,
}

impl Tracer<'_> {
    /// The matt part of a surface, in the share `share`, with its light rays pushed.
    pub(super) fn gather_matt(&mut self, surface: &Surface<'_>, share: Vec3, path: &Path) -> Matt {
        let diffuse = share * surface.base_color * (1.0 - surface.metallic);
        let gloss = Gloss::new(surface);
        let to_lamps = self.push_to_lamps(surface, diffuse, &gloss, path);

        // All of the surroundings are mirrored by metals, and by dielectrics the less the rougher
        // they are.
        let smooth = 1.0 - surface.roughness;
        let traced = smooth * smooth * (1.0 - surface.metallic) + surface.metallic;
        let fresnel = share * gloss.fresnel(surface.viewer.dot(surface.normal));
        let traced = ((fresnel * traced).max_element() * path.weight > 0.01).then_some(traced);
        let untraced = traced.map_or(fresnel, |traced| fresnel * (1.0 - traced));
        let ambient =
            Vec3::from(self.options.ambient) * (diffuse + untraced * (1.0 - surface.metallic));

        let count = self.options.ambient_rays.min(if path.bounces == 0 { u32::MAX } else { 1 });
        let may_be_blocked = count > 0 && ambient.max_element() * path.weight >= NEGLIGIBLE;
        let to_surroundings =
            may_be_blocked.then(|| self.push_to_surroundings(surface, count, path.sampler));
        Matt { share, gloss, traced, ambient, to_lamps, to_surroundings }
    }

    /// The light that the matt part of a surface sends to the viewer. Its light rays are answered.
    pub(super) fn matt(&mut self, surface: &Surface<'_>, matt: &Matt, path: &Path) -> Vec3 {
        let mut light = self.light_rays.sum(matt.to_lamps.clone());
        if let Some(traced) = matt.traced
            && let Some((direction, weight)) =
                matt.gloss.sample(path.sampler.fork(GLOSS).point(0, 1))
        {
            let weight = matt.share * weight * traced;
            light += self.bounce(surface, direction, weight, &path.bounced(GLOSS, weight, false));
        }
        let open = matt.to_surroundings.as_ref().map_or(Vec3::ONE, |rays| self.openness(rays));
        light + matt.ambient * open
    }
}
