//! Closed meshes on a lattice, and rays on the same lattice: f32 has every number, those of directions
//! included, so that a ray that should meet a vertex meets it, whoever computes in f32.

use crate::attack::Target;
use crate::closed::closed_part;
use crate::meshes;
use crate::rays::random;
use crate::shared::{load_mesh, scenes};
use kdray::{Ray, TriangleMesh};
use rand::RngExt;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64Mcg;

/// Vertices have at most so many steps on each side of zero, of [`STEP`]: middles of edges are a half of it.
const STEPS: f64 = 16_384.0;

/// The distance of two points of the lattice.
const STEP: f64 = 1.0 / STEPS;

/// The scenes whose closed parts are among the cases, if they are there.
const SCENES: [&str; 3] = ["armadillo", "cad_engine", "cad_cnc_counter"];

/// What rays are aimed at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aim {
    /// A vertex.
    Vertex,
    /// The middle of an edge.
    EdgeMiddle,
    /// A vertex, along an axis.
    AlongAxis,
    /// Somewhere.
    Anything,
}

impl Aim {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Vertex, Self::EdgeMiddle, Self::AlongAxis, Self::Anything];

    /// What is hard to hit; rays take turns.
    const HARD: [Self; 3] = [Self::Vertex, Self::EdgeMiddle, Self::AlongAxis];

    /// As tables call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Vertex => "at vertices",
            Self::EdgeMiddle => "at middles of edges",
            Self::AlongAxis => "along axes at vertices",
            Self::Anything => "anywhere",
        }
    }
}

/// A ray, what it is aimed at, and where it begins.
#[derive(Clone, Copy, Debug)]
pub struct Shot {
    /// The ray, without end; its numbers are those of f32.
    pub ray: Ray,
    /// Its aim.
    pub aim: Aim,
    /// Whether it begins in the inside; otherwise outside of the box.
    pub from_inside: bool,
}

/// A closed mesh and rays, hard or ordinary ones.
pub struct Case {
    /// What it is called.
    pub name: String,
    /// Whether rays are aimed at what is hard to hit.
    pub is_hard: bool,
    /// The mesh.
    pub target: Target,
    /// The rays.
    pub shots: Vec<Shot>,
}

/// All cases, with so many rays each: hard ones at every mesh, and ordinary ones.
pub fn all(rays: usize, seed: u64) -> Vec<Case> {
    let mut targets = vec![
        Target::new("cubes", on_lattice(&meshes::mesh(meshes::boxes(5)))),
        Target::new("sphere", on_lattice(&meshes::sphere(64))),
        Target::new("torus", on_lattice(&meshes::torus(192, 96))),
    ];
    for info in scenes().into_iter().flatten().filter(|it| SCENES.contains(&it.name.as_str())) {
        if let Ok(mesh) = load_mesh(&info) {
            targets.push(Target::new(info.name, on_lattice(&closed_part(&mesh))));
        }
    }
    targets.retain(|target| !target.mesh.triangles().is_empty());
    let both = |target: Target| {
        let inside = inside(&target, seed);
        [(target.clone(), true), (target, false)]
            .map(|(target, is_hard)| Case::new(target, is_hard, &inside, rays, seed))
    };
    targets.into_iter().flat_map(both).collect()
}

/// The same surface from −1 to 1, every vertex moved to the nearest point of the lattice.
fn on_lattice(mesh: &TriangleMesh) -> TriangleMesh {
    let bounds = kdray::Aabb::of_points(mesh.vertices().iter().copied());
    let (center, half) = (bounds.center(), 0.5 * bounds.extent().into_iter().fold(0.0, f64::max));
    let point = |p: &[f32; 3]| {
        std::array::from_fn(|k| on(STEP, (f64::from(p[k]) - center[k]) / half) as f32)
    };
    let vertices = mesh.vertices().iter().map(point).collect();
    TriangleMesh::new(vertices, mesh.triangles().to_vec()).expect("finite numbers stay so")
}

/// The nearest multiple of a step.
fn on(step: f64, x: f64) -> f64 {
    (x / step).round() * step
}

impl Case {
    fn new(target: Target, is_hard: bool, inside: &[[f64; 3]], rays: usize, seed: u64) -> Self {
        let mut random = random(seed);
        let aims: &[Aim] = if is_hard { &Aim::HARD } else { &[Aim::Anything] };
        let shot = |index: usize| {
            // Each aim has rays at everything.
            shot(&target, aims[index % aims.len()], index / aims.len(), inside, &mut random)
        };
        let shots = (0..rays).map(shot).collect();
        let name = format!("{}, {}", target.name, if is_hard { "hard" } else { "ordinary" });
        Self { name, is_hard, target, shots }
    }
}

/// Points in the inside, on the lattice.
fn inside(target: &Target, seed: u64) -> Vec<[f64; 3]> {
    let mut random = random(seed);
    let flat = crate::flat::Flat::new(&target.mesh);
    let mut points = Vec::new();
    for _ in 0..2000 {
        let point = [0; 3].map(|_| on(STEP, random.random_range(-1.0..1.0)));
        if crate::attack::aim::is_inside(&flat, point, &mut random) {
            points.push(point);
        }
    }
    points
}

fn shot(
    target: &Target,
    aim: Aim,
    turn: usize,
    inside: &[[f64; 3]],
    random: &mut Pcg64Mcg,
) -> Shot {
    let Target { mesh, vertices, edges, .. } = target;
    let vertex = |v: u32| mesh.vertices()[v as usize].map(f64::from);
    let goal: [f64; 3] = match aim {
        Aim::Vertex | Aim::AlongAxis => vertex(vertices[turn % vertices.len()]),
        Aim::EdgeMiddle => {
            let (a, b) = edges[turn % edges.len()];
            let (a, b) = (vertex(a), vertex(b));
            std::array::from_fn(|k| 0.5 * (a[k] + b[k]))
        }
        Aim::Anything => [0; 3].map(|_| on(STEP, random.random_range(-1.0..1.0))),
    };
    let is_along_axis = aim == Aim::AlongAxis;
    // One in four begins in the inside, where it can.
    let from_inside = !is_along_axis && random.random_range(0..4) == 0;
    let origin = match inside.choose(random).filter(|_| from_inside) {
        Some(&origin) => origin,
        None if is_along_axis => beyond(goal, 1.0, random),
        None => beyond([0; 3].map(|_| on(STEP, random.random_range(-2.0..2.0))), 2.0, random),
    };
    let from_inside = from_inside && !inside.is_empty();
    let ray = Ray::through(origin, goal);
    Shot { ray, aim, from_inside }
}

/// The point, moved along an axis to the outside of the box by up to so much.
fn beyond(mut point: [f64; 3], most: f64, random: &mut Pcg64Mcg) -> [f64; 3] {
    let sign = if random.random() { 1.0 } else { -1.0 };
    point[random.random_range(0..3)] =
        sign * (1.0 + STEP + on(STEP, random.random_range(0.0..most)));
    point
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn f32_has_every_number() {
        for case in all(400, 3) {
            assert!(case.target.is_closed, "{}", case.target.name);
            for Shot { ray, from_inside, .. } in &case.shots {
                let numbers = ray.origin.iter().chain(&ray.direction);
                assert!(numbers.into_iter().all(|&x| f64::from(x as f32) == x), "{ray:?}");
                assert!(*from_inside || !case.target.extent.contains(ray.origin), "{ray:?}");
                assert_eq!(ray.check(), Ok(()));
            }
        }
    }
}
