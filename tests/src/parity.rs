//! Counts of crossings on closed meshes: even from outside, odd from inside.

use crate::closed::vertices_and_edges;
use crate::rays::random;
use kdray::{Aabb, Ray, Scene};
use rand::RngExt;
use rayon::prelude::*;

/// From how many points outside each target is aimed at.
pub const OUTSIDE: usize = 100;

/// Counted rays.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Parity {
    /// How many rays were traced.
    pub rays: usize,
    /// How many of them crossed the surface an odd number of times.
    pub odd: usize,
    /// How many crossed it at all.
    pub crossing: usize,
    /// One that was odd, in words.
    pub example: Option<String>,
}

/// Aims at every vertex and every edge midpoint of `scene` from [`OUTSIDE`] points outside, and at
/// only every `step`-th of these pairs, in turn, if `step` is larger than one.
pub fn from_outside(scene: &Scene, step: usize) -> Parity {
    let (targets, origins) = (targets(scene), points_outside(scene.tree().bounds(), 1));
    let pairs = (0..targets.len() * OUTSIDE).into_par_iter().step_by(step);
    // A step that shares no factor with 100 reaches all origins; another still most.
    let count = |pair: usize| {
        let ray = Ray::through(origins[pair % OUTSIDE], targets[pair / OUTSIDE]);
        counted(scene, ray)
    };
    pairs.map(count).reduce(Parity::default, Parity::and)
}

/// Aims at every vertex and every edge midpoint from `origins`, each of which is inside, and so
/// counts an odd number of crossings where it goes right.
pub fn from_inside(scene: &Scene, origins: &[[f64; 3]]) -> Parity {
    let targets = targets(scene);
    let rays = origins
        .par_iter()
        .flat_map_iter(|origin| targets.iter().map(|target| Ray::through(*origin, *target)));
    rays.map(|ray| counted(scene, ray)).reduce(Parity::default, Parity::and)
}

fn counted(scene: &Scene, ray: Ray<3>) -> Parity {
    let count = scene.count(&ray);
    let odd = count % 2 == 1;
    let example = odd.then(|| format!("{ray:?} crosses {count} times"));
    Parity { rays: 1, odd: usize::from(odd), crossing: usize::from(count > 0), example }
}

impl Parity {
    fn and(self, other: Self) -> Self {
        Self {
            rays: self.rays + other.rays,
            odd: self.odd + other.odd,
            crossing: self.crossing + other.crossing,
            example: self.example.or(other.example),
        }
    }
}

/// The vertices and edge midpoints of the mesh.
fn targets(scene: &Scene) -> Vec<[f64; 3]> {
    let mesh = scene.mesh();
    let (vertices, edges) = vertices_and_edges(mesh);
    let position = |vertex: u32| mesh.vertices()[vertex as usize].map(f64::from);
    let middle = |(a, b): (u32, u32)| {
        let (a, b) = (position(a), position(b));
        std::array::from_fn(|k| 0.5 * (a[k] + b[k]))
    };
    let vertices = vertices.into_iter().map(position);
    vertices.chain(edges.into_iter().map(middle)).collect()
}

/// Points outside of a box: some a little, some far, some above a middle of its sides. All are f32,
/// so that a direction to a vertex is an f64 without rounding as long as they are not too far.
fn points_outside(bounds: &Aabb<3>, seed: u64) -> Vec<[f64; 3]> {
    let mut random = random(seed);
    let (center, extent) = (bounds.center(), bounds.extent());
    let mut outside = |index: usize| {
        let mut point: [f64; 3] = std::array::from_fn(|k| {
            let aligned = index.is_multiple_of(10);
            let offset = if aligned { 0.0 } else { random.random_range(-1.0..1.0) };
            center[k] + extent[k] * offset
        });
        let distance = [0.51, 0.75, 1.0, 2.0, 10.0][index % 5];
        let sign = if random.random() { 1.0 } else { -1.0 };
        point[index % 3] = center[index % 3] + sign * distance * bounds.diagonal();
        point.map(|x| f64::from(x as f32))
    };
    (0..OUTSIDE).map(&mut outside).collect()
}
