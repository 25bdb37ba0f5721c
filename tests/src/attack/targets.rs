//! What is shot at: closed meshes, whose crossings have a known parity, and awkward ones.

use crate::closed::{closed_part, is_closed, vertices_and_edges};
use crate::meshes::{self, Soup};
use crate::shared::{load_mesh, scenes};
use kdray::{Aabb, TriangleMesh};

/// Scenes with more triangles are left out, because their trees take too long to build again and again.
const MOST: usize = 520_000;

/// A mesh and where it can be aimed at.
#[derive(Clone, Debug)]
pub struct Target {
    /// What it is called in tables.
    pub name: String,
    /// The mesh.
    pub mesh: TriangleMesh,
    /// Its box.
    pub bounds: Aabb<3>,
    /// Whether every ray without end from outside crosses it an even number of times.
    pub is_closed: bool,
    /// The vertices that triangles use.
    pub vertices: Vec<u32>,
    /// The pairs of them that are edges.
    pub edges: Vec<(u32, u32)>,
}

impl Target {
    /// A mesh by that name.
    pub fn new(name: impl Into<String>, mesh: TriangleMesh) -> Self {
        let (vertices, edges) = vertices_and_edges(&mesh);
        let bounds = Aabb::of_points(vertices.iter().map(|&v| mesh.vertices()[v as usize]));
        let is_closed = is_closed(&mesh);
        Self { name: name.into(), mesh, bounds, is_closed, vertices, edges }
    }
}

/// The targets that are made by code.
pub fn made() -> Vec<Target> {
    let mut targets = closed();
    targets.extend(scaled());
    targets.extend(awkward());
    targets
}

fn closed() -> Vec<Target> {
    let pair = |a: &TriangleMesh, b: &TriangleMesh| meshes::mesh([soup_of(a), soup_of(b)].concat());
    let (sphere, torus) = (meshes::sphere(16), meshes::torus(24, 16));
    vec![
        Target::new("torus and sphere, crossing", pair(&torus, &moved(&sphere, [0.7, 0.1, 0.0]))),
        Target::new("sphere", sphere.clone()),
        Target::new("torus", torus),
        Target::new("cube of 8 x 8 cells a side", meshes::cube(8)),
        Target::new("5 x 5 x 5 cubes", meshes::mesh(meshes::boxes(5))),
        Target::new("sphere twice", pair(&sphere, &sphere)),
        Target::new("sphere of spikes", meshes::spikes(10, 1e3)),
        Target::new("sheet of two sides", meshes::pillow(8)),
        Target::new("fan of needles", meshes::spindle(200, 1e-5)),
    ]
}

/// Closed meshes of sizes and in places that f32 has little room for.
fn scaled() -> Vec<Target> {
    let of = |name: &str, mesh: TriangleMesh, by: fn([f64; 3]) -> [f64; 3]| {
        let point = |p: &[f32; 3]| by(p.map(f64::from)).map(|x| x as f32);
        let vertices = mesh.vertices().iter().map(point).collect();
        let mesh = TriangleMesh::new(vertices, mesh.triangles().to_vec());
        Target::new(name, mesh.expect("all scales keep within f32"))
    };
    let (sphere, torus) = (|| meshes::sphere(10), || meshes::torus(16, 10));
    vec![
        of("torus in UTM coordinates", torus(), |[x, y, z]| {
            [691_607.0 + 10.0 * x, 5_334_760.0 + 10.0 * y, 520.0 + 10.0 * z]
        }),
        of("sphere, size 1e30", sphere(), |p| p.map(|x| x * 1e30)),
        of("sphere, size 3e38", sphere(), |p| p.map(|x| x * 3e38)),
        of("torus, size 1e-30", torus(), |p| p.map(|x| x * 1e-30)),
        of("sphere of denormals", sphere(), |p| p.map(|x| x * 1e-41)),
        of("sphere, 1e3 x 1 x 1e-6", sphere(), |[x, y, z]| [1e3 * x, y, 1e-6 * z]),
        of("cube, 2^40 x 1 x 2^-40", meshes::cube(4), |[x, y, z]| {
            [x * 2.0_f64.powi(40), y, z * 2.0_f64.powi(-40)]
        }),
    ]
}

/// Meshes that are no surfaces of anything.
fn awkward() -> Vec<Target> {
    let of = |name: &str, soup: Soup| Target::new(name, meshes::mesh(soup));
    vec![
        of("soup", meshes::soup(400, [0.0; 3], 1.0, 1)),
        of("far soup", meshes::soup(200, [6e5, -5e6, 300.0], 40.0, 6)),
        of("coplanar squares in layers", meshes::grid(8, 3)),
        of("coplanar squares, overlapping", overlapping(300)),
        of("needles", meshes::needles(200, 9)),
        of("degenerate and double triangles", meshes::degenerate(10)),
        of("one triangle", meshes::soup(1, [0.0; 3], 1.0, 13)),
        of("one triangle 40 times", [meshes::grid(1, 1)[0]; 40].to_vec()),
    ]
}

/// Triangles of many sizes in three planes, corners on a lattice: edges lie in each other.
fn overlapping(count: usize) -> Soup {
    let place = |i: usize| [i * 7 % 16, i * 11 % 16, i % 3].map(|x| x as f32);
    let size = |i: usize| (1 + i % 5) as f32;
    let triangle = |i: usize| {
        let ([x, y, z], s) = (place(i), size(i));
        [[x, y, z], [x + s, y, z], [x, y + s, z]]
    };
    (0..count).map(triangle).collect()
}

/// The scenes beside the checkout, if they are there: the closed part of those that have one, and all
/// awkward ones as they are. Only those of at most so many triangles.
pub fn of_scenes(most: usize) -> Vec<Target> {
    let listed = scenes().into_iter().flatten().filter(|info| info.triangles <= most.min(MOST));
    let loaded = listed.filter_map(|info| Some((load_mesh(&info).ok()?, info.name)));
    let targets = loaded.flat_map(|(mesh, name)| {
        let closed = closed_part(&mesh);
        let whole = name.starts_with("awkward").then(|| Target::new(&name, mesh));
        let is_worth_it = closed.triangles().len() >= 100;
        let closed = is_worth_it.then(|| Target::new(format!("{name}, closed part"), closed));
        [closed, whole].into_iter().flatten()
    });
    targets.filter(|target| !target.mesh.triangles().is_empty()).collect()
}

fn soup_of(mesh: &TriangleMesh) -> Soup {
    (0..mesh.triangles().len() as u32).map(|id| mesh.corners(id)).collect()
}

fn moved(mesh: &TriangleMesh, by: [f32; 3]) -> TriangleMesh {
    let point = |p: &[f32; 3]| std::array::from_fn(|k| p[k] + by[k]);
    let vertices = mesh.vertices().iter().map(point).collect();
    TriangleMesh::new(vertices, mesh.triangles().to_vec()).expect("the move is small")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_should_be_closed_is() {
        assert!(closed().iter().chain(&scaled()).all(|target| target.is_closed));
        assert!(awkward().iter().filter(|target| target.is_closed).count() <= 1);
    }
}
