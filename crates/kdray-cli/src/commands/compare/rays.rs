//! The rays that all contenders answer.

use super::Args;
use crate::error::CliError;
use glam::DVec3;
use kdray::{Aabb, Ray, ShapeScene};
use kdray_render::{HitPoint, RenderError, View, default_lights};
use kdray_scene::{Light, Model};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A set of rays and the question that is asked of each.
pub(super) struct RaySet {
    /// What it is called.
    pub(super) name: &'static str,
    /// Whether any hit will do.
    pub(super) any: bool,
    /// The rays.
    pub(super) rays: Vec<Ray>,
}

/// The sets in the order in which they are measured.
pub(super) struct RaySets {
    /// Primary, shadow, bounce.
    pub(super) sets: [RaySet; 3],
    /// How many pixels across and down the primary rays go through.
    pub(super) grid: [usize; 2],
}

impl RaySets {
    /// The rays for a camera and the first light, as far as `scene` is hit.
    pub(super) fn new(
        args: &Args,
        model: &Model,
        scene: Option<&ShapeScene>,
    ) -> Result<Self, CliError> {
        let empty = Aabb::EMPTY;
        let bounds = scene.map_or(&empty, |scene| scene.tree().bounds());
        let camera = args.view.camera(model, bounds)?;
        let lights = args.view.lights(model, bounds);
        let view = View::new(&camera, args.view.aspect()).map_err(RenderError::from)?;
        let grid = grid(args.rays, args.view.aspect());
        let primary = primary(&view, grid);
        let places = scene.map_or(Vec::new(), |scene| places(scene, &primary));
        // A light of the command line comes first: it was asked for.
        let light = lights.get(model.lights.len()).or(lights.first()).cloned();
        let light = light.or_else(|| default_lights(&camera, bounds).pop());
        let shadow = light.map_or(Vec::new(), |light| shadow(&places, &light));
        let bounce = bounce(&places);
        let set = |name, any, rays| RaySet { name, any, rays };
        let sets = [
            set("primary", false, primary),
            set("shadow", true, shadow),
            set("bounce", false, bounce),
        ];
        Ok(Self { sets, grid })
    }
}

/// About `count` pixels of a picture `aspect` times as wide as high.
pub(super) fn grid(count: u32, aspect: f64) -> [usize; 2] {
    let count = f64::from(count);
    let width = (count * aspect).sqrt().round().clamp(1.0, count);
    [width as usize, (count / width).round().max(1.0) as usize]
}

fn primary(view: &View, [width, height]: [usize; 2]) -> Vec<Ray> {
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let middle = |i: usize, count: usize| (i as f64 + 0.5) / count as f64;
    pixels.map(|(x, y)| view.ray(middle(x, width), middle(y, height))).collect()
}

/// Where the rays hit.
fn places(scene: &ShapeScene, rays: &[Ray]) -> Vec<HitPoint> {
    let place = |ray| Some(HitPoint::new(scene.primitives(), ray, &scene.closest_hit(ray)?));
    rays.iter().filter_map(place).collect()
}

/// To the light, and no farther.
fn shadow(places: &[HitPoint], light: &Light) -> Vec<Ray> {
    let to = |place: &HitPoint, target: [f64; 3]| place.ray_to(target).with_interval(0.0, 1.0);
    let ray = |place: &HitPoint| match *light {
        Light::Point { position, .. } => to(place, position),
        Light::Directional { direction, .. } => place.ray_along(-DVec3::from(direction)),
        Light::Rectangle { corner, edge_u, edge_v, .. } => {
            let middle = DVec3::from(corner) + (DVec3::from(edge_u) + DVec3::from(edge_v)) / 2.0;
            to(place, middle.into())
        }
    };
    places.iter().map(ray).collect()
}

/// One ray from each place, distributed by the cosine to the normal: the normal plus a point of
/// the unit sphere. The same ones every time.
fn bounce(places: &[HitPoint]) -> Vec<Ray> {
    let mut random = Pcg64Mcg::seed_from_u64(0);
    let direction = |place: &HitPoint| {
        let z: f64 = random.random_range(-1.0..1.0);
        let angle: f64 = random.random_range(0.0..std::f64::consts::TAU);
        let r = (1.0 - z * z).sqrt();
        let sphere = DVec3::new(r * angle.cos(), r * angle.sin(), z);
        let facing = DVec3::from(place.facing());
        place.ray_along((facing + sphere).normalize_or(facing))
    };
    places.iter().map(direction).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use kdray::{BuildOptions, TriangleMesh};

    #[test]
    fn grids_have_the_shape_of_the_picture() {
        assert_eq!(grid(60_000, 1.5), [300, 200]);
        assert_eq!(grid(1, 1.5), [1, 1]);
        assert_eq!(grid(100, 1e9), [100, 1]);
    }

    #[test]
    fn secondary_rays_leave_their_own_surface() {
        // Far from the origin and slanted, so that points are rounded.
        let corners = [[1000.1, 0.3, 7.7], [1003.2, 0.9, 8.1], [1001.3, 2.7, 6.3]];
        let mesh = TriangleMesh::from_soup([corners]).unwrap();
        let scene = ShapeScene::build(mesh, &BuildOptions::default()).unwrap();
        let eye = [1000.0, 1.0, 0.0];
        let mut places = Vec::new();
        for i in 0..200 {
            let target = [1000.5 + f64::from(i % 20) * 0.1, 0.5 + f64::from(i / 20) * 0.1, 7.5];
            places.extend(super::places(&scene, &[Ray::through(eye, target)]));
        }
        assert!(places.len() > 50, "{}", places.len());
        let light = Light::Point { position: eye, intensity: [1.0; 3], cone: None };
        for ray in shadow(&places, &light).iter().chain(&bounce(&places)) {
            assert!(!scene.any_hit(ray), "{ray:?}");
        }
    }
}
