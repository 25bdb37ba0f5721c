//! Closest hits through trees, against every triangle.

use crate::Subject;
use crate::flat::Flat;
use crate::oracle::{agrees_on_all, agrees_on_closest};
use crate::rays::random;
use crate::shared::CameraInfo;
use glam::DVec3;
use kdray::primitives::HitRule;
use kdray::{BuildOptions, Hit, Ray, Scene, Strategy, TriangleMesh};
use rand::RngExt;
use rayon::prelude::*;

/// What a comparison found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Differences {
    /// Rays on which one answer is a hit and the other a miss.
    pub hit_or_miss: usize,
    /// Rays on which the primitives differ though t does not allow it.
    pub primitive: usize,
    /// Rays on which the answers differ in any other bit.
    pub other: usize,
    /// One ray of the first kind found, with both answers.
    pub example: Option<String>,
}

impl Differences {
    /// Whether there are none.
    pub fn none(&self) -> bool {
        (self.hit_or_miss, self.primitive, self.other) == (0, 0, 0)
    }
}

/// The rays of a picture of `size` x `size` pixels, through the middle of each.
pub fn view(camera: &CameraInfo, size: usize) -> Vec<Ray<3>> {
    let [eye, look_at, up] = [camera.eye, camera.look_at, camera.up].map(DVec3::from);
    let forward = (look_at - eye).normalize();
    let right = forward.cross(up).normalize();
    let up = right.cross(forward);
    let half = (camera.vfov_deg.to_radians() / 2.0).tan();
    let place = |i: usize| (2.0 * (i as f64 + 0.5) / size as f64 - 1.0) * half;
    let ray = |(x, y): (usize, usize)| {
        let (x, y) = (place(x), -place(y));
        Ray::new(eye, forward + x * right + y * up)
    };
    (0..size).flat_map(|y| (0..size).map(move |x| (x, y))).map(ray).collect()
}

/// Rays between random points of a box a quarter larger than that of the mesh, and for a flat mesh
/// not flat.
pub fn random_rays(mesh: &TriangleMesh, count: usize, seed: u64) -> Vec<Ray<3>> {
    let bounds = kdray::Aabb::of_points(
        mesh.triangles().iter().flatten().map(|&v| mesh.vertices()[v as usize]),
    );
    if bounds.is_empty() {
        return vec![Ray::new([0.0; 3], [1.0; 3]); count];
    }
    let mut random = random(seed);
    let center = bounds.center();
    let half = bounds.extent().map(|side| 0.625 * side.max(0.1 * bounds.diagonal()));
    let mut point = || -> [f64; 3] {
        std::array::from_fn(|k| center[k] + half[k] * random.random_range(-1.0..=1.0))
    };
    (0..count).map(|_| Ray::through(point(), point())).collect()
}

/// A scene's answers to all queries, compared with rational arithmetic on every triangle.
///
/// # Errors
/// A sentence about the first ray with a wrong answer.
pub fn agrees_with_the_oracle(scene: &Scene, rays: &[Ray<3>]) -> Result<(), String> {
    rays.par_iter()
        .try_for_each(|ray| is_right(scene, ray).map_err(|error| format!("{ray:?}: {error}")))
}

fn is_right(scene: &Scene, ray: &Ray<3>) -> Result<(), String> {
    let exact = |rule| scene.mesh().exact_hits(ray, rule).unwrap_or_default();
    let (touched, crossed) = (exact(HitRule::Touching), exact(HitRule::Crossing));
    let closest = scene.closest_hit(ray);
    agrees_on_closest(&touched, closest.as_ref(), ray)?;
    if scene.any_hit(ray) != closest.is_some() {
        return Err("any_hit and closest_hit differ".to_owned());
    }
    let hits: Vec<Hit> = scene.all_hits(ray).collect();
    agrees_on_all(&crossed, &hits, ray)?;
    agrees_on_all(&touched, &scene.all_touched(ray).collect::<Vec<_>>(), ray)?;
    match scene.count(ray) {
        count if count == hits.len() => Ok(()),
        count => Err(format!("count is {count}, but there are {} hits", hits.len())),
    }
}

/// The answers without a tree.
pub fn flat_answers(mesh: &TriangleMesh, rays: &[Ray<3>]) -> Vec<Option<Hit>> {
    let flat = Flat::new(mesh);
    rays.par_iter().map(|ray| flat.closest_hit(ray)).collect()
}

/// Builds a tree over `mesh` and compares its closest hits with `answers`.
///
/// # Panics
/// If the build is refused.
pub fn compare(
    mesh: &TriangleMesh,
    strategy: Strategy,
    rays: &[Ray<3>],
    answers: &[Option<Hit>],
) -> Differences {
    let options = BuildOptions::for_strategy(strategy);
    let scene = Scene::build(mesh.clone(), &options).expect("a valid mesh has a tree");
    let found: Vec<_> = rays.par_iter().map(|ray| scene.closest_hit(ray)).collect();
    let mut differences = Differences::default();
    for ((ray, found), answer) in rays.iter().zip(found).zip(answers) {
        let kind = match (found, answer) {
            (found, answer) if found == *answer => continue,
            (Some(found), Some(answer)) if found.t == answer.t => &mut differences.other,
            (Some(_), Some(_)) => &mut differences.primitive,
            _ => &mut differences.hit_or_miss,
        };
        *kind += 1;
        let example = || format!("{ray:?}: {found:?}, without a tree {answer:?}");
        differences.example.get_or_insert_with(example);
    }
    differences
}
