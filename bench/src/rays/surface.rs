//! Where secondary rays start.

use super::Ray;
use crate::scene::BenchScene;
use glam::{DVec3, Vec3};
use kdray::Hit;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::f64::consts::TAU;

/// How far a ray's origin is moved off the surface, by the scene's diagonal. All contenders but
/// kdray round as f32 does; they must not hit the surface that the ray leaves.
const OFFSET: f64 = 1e-5;

/// A point just off a surface that was hit.
pub(super) struct Place {
    /// Moved to the side of arrival.
    pub(super) origin: [f32; 3],
    /// The unit normal on that side.
    pub(super) facing: DVec3,
}

/// The points just off where the primary rays hit.
pub(super) struct Places {
    pub(super) list: Vec<Place>,
    /// For each the index of its primary ray.
    pub(super) parents: Vec<u32>,
}

impl Places {
    /// Those of the rays that hit, in order. Hits on triangles whose normal cannot be told are left
    /// out.
    pub(super) fn of_hits(hits: &[Option<Hit>], rays: &[Ray], scene: &BenchScene) -> Self {
        let mut places = Self { list: Vec::new(), parents: Vec::new() };
        for (index, (hit, ray)) in hits.iter().zip(rays).enumerate() {
            if let Some(place) = hit.as_ref().and_then(|hit| place(hit, ray, scene)) {
                places.list.push(place);
                places.parents.push(index as u32);
            }
        }
        places
    }

    /// A direction for each place, distributed by the cosine to the normal: the normal plus a
    /// point of the unit sphere. `seed` tells sets apart; the same seed gives the same directions.
    pub(super) fn cosine_directions(&self, seed: u64) -> Vec<[f32; 3]> {
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let mut direction = |place: &Place| {
            let z: f64 = random.random_range(-1.0..1.0);
            let angle: f64 = random.random_range(0.0..TAU);
            let r = (1.0 - z * z).sqrt();
            let sphere = DVec3::new(r * angle.cos(), r * angle.sin(), z);
            (place.facing + sphere).normalize_or(place.facing).as_vec3().into()
        };
        self.list.iter().map(&mut direction).collect()
    }
}

fn place(hit: &Hit, ray: &Ray, scene: &BenchScene) -> Option<Place> {
    let corners = scene.mesh.corners(hit.primitive_id).map(|p| Vec3::from(p).as_dvec3());
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a).try_normalize()?;
    let arrival = Vec3::from(ray.direction).as_dvec3();
    let facing = if normal.dot(arrival) > 0.0 { -normal } else { normal };
    let point = a + hit.u * (b - a) + hit.v * (c - a);
    let origin = point + OFFSET * scene.diagonal * facing;
    Some(Place { origin: origin.as_vec3().into(), facing })
}
