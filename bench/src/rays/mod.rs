//! The rays that all contenders trace: five sets, the same f32 numbers for everyone.

mod ao;
mod ao_shared;
mod diffuse;
mod file;
mod primary;
mod sample;
mod shadow;
mod surface;

use crate::error::BenchError;
use crate::reference::Reference;
use crate::scene::BenchScene;
use kdray_render::View;
use std::path::Path;
use surface::Places;

/// A ray: the points origin + t · direction for t from 0 to `t_max`, both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ray {
    /// Where it starts.
    pub(crate) origin: [f32; 3],
    /// Where it goes; of unit length but for shadow rays, which reach the light at t = 1.
    pub(crate) direction: [f32; 3],
    /// Where it ends; infinite for primary and diffuse rays.
    pub(crate) t_max: f32,
}

/// What is asked of each ray of a set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Question {
    /// The nearest hit: its t and its triangle.
    Closest,
    /// Whether there is any hit.
    Any,
}

/// The sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SetKind {
    /// Through the pixels of a picture.
    Primary,
    /// From the primary hits in random directions, by the cosine to the normal.
    Diffuse,
    /// From the primary hits to the point light.
    Shadow,
    /// Like diffuse rays, but only a tenth of the scene's diagonal long.
    Ao,
    /// As long, but all rays of a tile of pixels go in the same direction.
    AoShared,
}

impl SetKind {
    /// All of them, in the order in which they are told.
    pub(crate) const ALL: [Self; 5] =
        [Self::Primary, Self::Diffuse, Self::Shadow, Self::Ao, Self::AoShared];

    /// The name that it has on the command line and in tables.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Primary => "primary",
            Self::Diffuse => "diffuse",
            Self::Shadow => "shadow",
            Self::Ao => "ao",
            Self::AoShared => "ao-shared",
        }
    }

    /// What is asked.
    pub(crate) fn question(self) -> Question {
        match self {
            Self::Primary | Self::Diffuse => Question::Closest,
            Self::Shadow | Self::Ao | Self::AoShared => Question::Any,
        }
    }

    /// The sets of these names; all for none.
    pub(crate) fn of_names(names: &[String]) -> Result<Vec<Self>, BenchError> {
        if names.is_empty() {
            return Ok(Self::ALL.to_vec());
        }
        let named = |name: &String| {
            let found = Self::ALL.into_iter().find(|kind| kind.name() == name);
            let names = Self::ALL.map(Self::name).join(", ");
            let none = || format!("no set is called {name}; give some of {names}");
            found.ok_or_else(|| BenchError::Usage(none()))
        };
        names.iter().map(named).collect()
    }
}

/// A set of rays.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RaySet {
    /// Which one.
    pub(crate) kind: SetKind,
    /// The rays, in the order of the pixels: see [`tile_order`](kdray::geometry::tile_order).
    pub(crate) rays: Vec<Ray>,
    /// For each ray the index of the primary ray from whose hit it starts; empty for primary rays.
    pub(crate) parents: Vec<u32>,
}

/// All sets of a scene.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RaySets {
    /// Pixels across and down.
    pub(crate) resolution: u32,
    /// The sets, in the order of [`SetKind::ALL`].
    pub(crate) sets: [RaySet; 5],
}

impl RaySets {
    /// The rays of a scene, as `reference` says where the primary ones hit.
    pub(crate) fn make(
        scene: &BenchScene,
        reference: &Reference,
        resolution: u32,
    ) -> Result<Self, BenchError> {
        let view = View::new(&scene.camera, 1.0)?;
        let primary = primary::rays(&view, resolution);
        let places = Places::of_hits(&reference.hits(&primary), &primary, scene);
        let set = |kind, rays: Vec<Ray>| RaySet { kind, rays, parents: places.parents.clone() };
        let (shared, parents) = ao_shared::rays(&places, scene.diagonal);
        let ao_shared = RaySet { kind: SetKind::AoShared, rays: shared, parents };
        let diffuse = set(SetKind::Diffuse, diffuse::rays(&places));
        let shadow = set(SetKind::Shadow, shadow::rays(&places, scene.light));
        let ao = set(SetKind::Ao, ao::rays(&places, scene.diagonal));
        let primary = RaySet { kind: SetKind::Primary, rays: primary, parents: Vec::new() };
        Ok(Self { resolution, sets: [primary, diffuse, shadow, ao, ao_shared] })
    }

    /// The rays from their file in `folder`; made, and kept there, if they are not there yet.
    pub(crate) fn get(
        scene: &BenchScene,
        reference: &Reference,
        resolution: u32,
        folder: &Path,
    ) -> Result<Self, BenchError> {
        let key = file::Key::of(scene, resolution);
        if let Some(kept) = file::read(folder, &key) {
            return Ok(kept);
        }
        let made = Self::make(scene, reference, resolution)?;
        file::write(folder, &key, &made)?;
        Ok(made)
    }

    /// The set of that kind.
    pub(crate) fn set(&self, kind: SetKind) -> &RaySet {
        &self.sets[kind as usize]
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use glam::{DVec3, Vec3};

    /// A small terrain, its exact answers, and its rays.
    pub(crate) fn terrain() -> (BenchScene, Reference, RaySets) {
        let scene = crate::synthetic::scene("terrain-10k").unwrap().unwrap();
        let reference = Reference::build(&scene.mesh).unwrap();
        let sets = RaySets::make(&scene, &reference, 64).unwrap();
        (scene, reference, sets)
    }

    #[test]
    fn sets_are_what_they_say() {
        let (scene, reference, sets) = terrain();
        let [primary, diffuse, shadow, ao, _] = &sets.sets;
        assert_eq!(primary.rays.len(), 64 * 64);
        let hits = reference.hits(&primary.rays);
        let count = hits.iter().flatten().count();
        assert!(count > 500, "{count} primary hits");
        for set in [diffuse, shadow, ao] {
            assert_eq!((set.rays.len(), set.parents.len()), (count, count));
        }
        let light = DVec3::from(scene.light).as_vec3();
        for i in 0..count {
            let parent = primary.rays[diffuse.parents[i] as usize];
            let hit = hits[diffuse.parents[i] as usize].expect("parents hit");
            let normal = DVec3::from(scene.mesh.geometric_normal(hit.primitive_id)).normalize();
            let arrival = Vec3::from(parent.direction).as_dvec3();
            let facing = if normal.dot(arrival) > 0.0 { -normal } else { normal }.as_vec3();
            // Origins lie on the side of arrival, near the hit.
            let place = Vec3::from(parent.origin) + Vec3::from(parent.direction) * hit.t as f32;
            for set in [diffuse, shadow, ao] {
                let offset = Vec3::from(set.rays[i].origin) - place;
                assert!(offset.dot(facing) > 0.0 && offset.length() < 1e-4, "{offset}");
            }
            // Cosine directions leave the surface.
            for set in [diffuse, ao] {
                let direction = Vec3::from(set.rays[i].direction);
                assert!((direction.length() - 1.0).abs() < 1e-5);
                assert!(direction.dot(facing) > -1e-6, "{direction}");
            }
            assert_eq!(diffuse.rays[i].t_max, f32::INFINITY);
            assert_eq!(ao.rays[i].t_max, (0.1 * scene.diagonal) as f32);
            // Shadow rays end just before the light.
            let Ray { origin, direction, t_max } = shadow.rays[i];
            let end = Vec3::from(origin) + t_max * Vec3::from(direction);
            let (left, all) = (end.distance(light), Vec3::from(direction).length());
            assert!(left > 0.0 && left < 1e-3 * all, "{left} of {all}");
        }
    }

    #[test]
    fn shadow_rays_meet_in_the_light() {
        let (scene, _, sets) = terrain();
        let light = |ray: &Ray| {
            let [o, d] = [ray.origin, ray.direction].map(|v| DVec3::from(v.map(f64::from)));
            o + d
        };
        let rays = &sets.set(SetKind::Shadow).rays;
        let first = light(&rays[0]);
        assert!(first.distance(DVec3::from(scene.light)) < 1e-5);
        assert!(rays.iter().all(|ray| light(ray) == first));
    }

    #[test]
    fn rays_of_a_tile_share_a_direction_off_the_surface() {
        let (scene, reference, sets) = terrain();
        let hits = reference.hits(&sets.sets[0].rays);
        let set = sets.set(SetKind::AoShared);
        let mut directions: Vec<_> = set.rays.iter().map(|ray| ray.direction).collect();
        directions.dedup();
        assert!((2..=16).contains(&directions.len()), "one of 16 tiles each");
        for (ray, &parent) in set.rays.iter().zip(&set.parents) {
            let hit = hits[parent as usize].expect("parents hit");
            let normal = DVec3::from(scene.mesh.geometric_normal(hit.primitive_id));
            let arrival = Vec3::from(sets.sets[0].rays[parent as usize].direction).as_dvec3();
            let direction = Vec3::from(ray.direction).as_dvec3();
            assert!(normal.dot(arrival) * normal.dot(direction) < 0.0);
        }
    }

    #[test]
    fn cosine_directions_have_the_mean_cosine_two_thirds() {
        let (scene, reference, sets) = terrain();
        let hits = reference.hits(&sets.sets[0].rays);
        for kind in [SetKind::Diffuse, SetKind::Ao] {
            let set = sets.set(kind);
            let cosine = |(ray, &parent): (&Ray, &u32)| {
                let hit = hits[parent as usize].expect("parents hit");
                let normal = DVec3::from(scene.mesh.geometric_normal(hit.primitive_id));
                normal.normalize().dot(Vec3::from(ray.direction).as_dvec3()).abs()
            };
            let sum: f64 = set.rays.iter().zip(&set.parents).map(cosine).sum();
            let mean = sum / set.rays.len() as f64;
            assert!((mean - 2.0 / 3.0).abs() < 0.03, "{mean}");
        }
    }

    #[test]
    fn rays_are_the_same_every_time() {
        assert_eq!(terrain().2, terrain().2);
    }

    #[test]
    fn sets_have_names() {
        let names = ["ao".to_owned(), "primary".to_owned()];
        assert_eq!(SetKind::of_names(&names).unwrap(), [SetKind::Ao, SetKind::Primary]);
        assert_eq!(SetKind::of_names(&[]).unwrap().len(), 5);
        assert!(SetKind::of_names(&["sunshine".to_owned()]).is_err());
    }
}
