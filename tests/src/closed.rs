//! Which parts of a mesh are closed surfaces.

use kdray::{Coordinate, TriangleMesh};
use std::collections::{HashMap, HashSet};

/// The triangles of a mesh that belong to closed components, as a mesh of its own.
///
/// Vertices at the same position are taken as one. Triangles that share an edge are one component,
/// and it is closed if each of its edges has exactly two triangles, which run along it in opposite
/// directions. Triangles with two corners at the same position are left out first.
pub fn closed_part(mesh: &TriangleMesh) -> TriangleMesh {
    let (positions, triangles) = welded(mesh);
    let mut edges: HashMap<(u32, u32), EdgeUse> = HashMap::new();
    for (index, triangle) in triangles.iter().enumerate() {
        for (from, to) in sides(triangle) {
            edges.entry((from.min(to), from.max(to))).or_default().add(index, from < to);
        }
    }
    let mut components = Components::new(triangles.len());
    for edge in edges.values() {
        for &other in &edge.triangles {
            components.join(edge.triangles[0], other);
        }
    }
    let mut open = vec![false; triangles.len()];
    for edge in edges.values().filter(|edge| !edge.is_closed()) {
        open[components.root(edge.triangles[0])] = true;
    }
    let kept = (0..triangles.len()).filter(|&index| !open[components.root(index)]);
    let kept = kept.map(|index| triangles[index]).collect();
    TriangleMesh::new(positions, kept).expect("parts of a valid mesh are valid")
}

/// Whether a ray without end from outside of the box of `mesh` crosses it an even number of times, however
/// it lies: if every edge has an even number of triangles, vertices at the same position taken as one.
pub fn is_closed<T: Coordinate>(mesh: &TriangleMesh<T>) -> bool {
    // Adding zero makes the two zeros one.
    let place =
        |vertex: u32| mesh.vertices()[vertex as usize].map(|x| (x.to_f64() + 0.0).to_bits());
    let mut odd = HashSet::new();
    for triangle in mesh.triangles() {
        for (a, b) in sides(triangle).map(|(a, b)| (place(a), place(b))) {
            let edge = (a.min(b), a.max(b));
            if a != b && !odd.remove(&edge) {
                odd.insert(edge);
            }
        }
    }
    odd.is_empty()
}

/// A mesh without doubles of positions and without triangles that use a position twice.
fn welded(mesh: &TriangleMesh) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let mut positions = Vec::new();
    let mut known = HashMap::new();
    let mut weld = |vertex: u32| {
        let position = mesh.vertices()[vertex as usize];
        // Adding zero makes the two zeros one.
        *known.entry(position.map(|x| (x + 0.0).to_bits())).or_insert_with(|| {
            positions.push(position);
            positions.len() as u32 - 1
        })
    };
    let mut triangles: Vec<_> = mesh.triangles().iter().map(|t| t.map(&mut weld)).collect();
    triangles.retain(|[a, b, c]| a != b && b != c && c != a);
    (positions, triangles)
}

fn sides(&[a, b, c]: &[u32; 3]) -> [(u32, u32); 3] {
    [(a, b), (b, c), (c, a)]
}

/// The vertices that triangles use, and the pairs of them that are edges, each once, in order.
pub fn vertices_and_edges<T: Coordinate>(mesh: &TriangleMesh<T>) -> (Vec<u32>, Vec<(u32, u32)>) {
    let mut vertices: Vec<u32> = mesh.triangles().iter().flatten().copied().collect();
    let all = mesh.triangles().iter().flat_map(sides);
    let mut edges: Vec<_> = all.map(|(a, b)| (a.min(b), a.max(b))).collect();
    vertices.sort_unstable();
    vertices.dedup();
    edges.sort_unstable();
    edges.dedup();
    (vertices, edges)
}

/// The triangles at an edge.
#[derive(Default)]
struct EdgeUse {
    triangles: Vec<usize>,
    rising: usize,
}

impl EdgeUse {
    fn add(&mut self, triangle: usize, rising: bool) {
        self.triangles.push(triangle);
        self.rising += usize::from(rising);
    }

    fn is_closed(&self) -> bool {
        self.triangles.len() == 2 && self.rising == 1
    }
}

/// Disjoint sets (Tarjan 1975).
struct Components(Vec<usize>);

impl Components {
    fn new(count: usize) -> Self {
        Self((0..count).collect())
    }

    fn root(&mut self, mut index: usize) -> usize {
        while self.0[index] != index {
            self.0[index] = self.0[self.0[index]];
            index = self.0[index];
        }
        index
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshes::{boxes, grid, mesh, sphere, torus};

    fn closed_triangles(mesh: &TriangleMesh) -> usize {
        closed_part(mesh).triangles().len()
    }

    #[test]
    fn spheres_and_tori_are_closed_and_grids_are_not() {
        let (sphere, torus) = (sphere(5), torus(7, 5));
        assert_eq!(closed_triangles(&sphere), sphere.triangles().len());
        assert_eq!(closed_triangles(&torus), torus.triangles().len());
        assert_eq!(closed_triangles(&mesh(grid(3, 2))), 0);
        assert_eq!(closed_triangles(&mesh(boxes(1))), 12);
    }

    #[test]
    fn cubes_side_by_side_are_closed_and_without_a_triangle_they_are_not() {
        let mut soup = boxes(2);
        assert!(is_closed(&mesh(soup.clone())));
        soup.pop();
        assert!(!is_closed(&mesh(soup)));
        assert!(is_closed(&torus(7, 5)) && !is_closed(&mesh(grid(3, 2))));
    }

    #[test]
    fn a_component_with_a_hole_or_a_turned_triangle_is_not_closed() {
        let mut soup = boxes(1);
        let far = boxes(1).into_iter().map(|t| t.map(|p| p.map(|x| x + 5.0)));
        soup.extend(far);
        assert_eq!(closed_triangles(&mesh(soup.clone())), 24);
        soup.pop();
        assert_eq!(closed_triangles(&mesh(soup.clone())), 12);
        soup[0].swap(0, 1);
        assert_eq!(closed_triangles(&mesh(soup)), 0);
    }

    #[test]
    fn every_edge_is_listed_once() {
        let (vertices, edges) = vertices_and_edges(&torus(7, 5));
        assert_eq!((vertices.len(), edges.len()), (35, 105));
    }
}
