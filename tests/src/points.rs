//! Points that are hard on purpose, and the answers for them without a tree.

use crate::rays::Archer;
use kdray::primitives::{closest_on_triangle, solid_angle};
use kdray::{ClosestPoint, Coordinate, TriangleMesh};

/// Points of every kind, about `each` of a kind: at vertices, edges and faces of a mesh, one unit in
/// the last place beside them, around the mesh, and up to `farthest` diagonals away.
pub fn points<T: Coordinate>(
    mesh: &TriangleMesh<T>,
    each: usize,
    farthest: f64,
    seed: u64,
) -> Vec<[f64; 3]> {
    let mut archer = Archer::new(mesh, seed);
    if archer.is_at_nothing() {
        return vec![[0.0; 3]];
    }
    let mut points = Vec::new();
    for _ in 0..each {
        let on_surface = [archer.corner(), on_edge(archer.edge()), on_face(&archer.corners())];
        points.extend(on_surface);
        points.extend(on_surface.iter().flat_map(beside));
        points.extend([archer.around(0.0), archer.around(0.5), archer.point_afar(farthest)]);
    }
    points
}

fn on_edge((a, b): ([f64; 3], [f64; 3])) -> [f64; 3] {
    std::array::from_fn(|k| 0.5 * (a[k] + b[k]))
}

fn on_face(corners: &[[f64; 3]]) -> [f64; 3] {
    let (a, b, c) = (corners[0], corners[1], corners[2]);
    std::array::from_fn(|k| 0.25 * a[k] + 0.25 * b[k] + 0.5 * c[k])
}

/// The six neighbours of a point in f64.
pub fn beside(point: &[f64; 3]) -> [[f64; 3]; 6] {
    std::array::from_fn(|i| {
        let mut beside = *point;
        let x = beside[i / 2];
        beside[i / 2] = if i % 2 == 0 { x.next_up() } else { x.next_down() };
        beside
    })
}

/// The corners of a triangle in f64.
pub fn corners<T: Coordinate>(mesh: &TriangleMesh<T>, id: u32) -> [[f64; 3]; 3] {
    mesh.corners(id).map(|p| p.map(T::to_f64))
}

/// The nearest point, by testing every triangle.
pub fn naive_closest_point<T: Coordinate>(
    mesh: &TriangleMesh<T>,
    point: [f64; 3],
) -> Option<ClosestPoint> {
    let ids = 0..mesh.triangles().len() as u32;
    let all = ids.map(|id| closest_on_triangle(point, corners(mesh, id), id));
    all.reduce(|best, other| if other.precedes(&best) { other } else { best })
}

/// The winding number, by summing every triangle.
pub fn naive_winding_number<T: Coordinate>(mesh: &TriangleMesh<T>, point: [f64; 3]) -> f64 {
    (0..mesh.triangles().len() as u32).map(|id| solid_angle(point, corners(mesh, id))).sum()
}
