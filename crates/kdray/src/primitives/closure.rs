//! Whether a mesh is closed.

use super::TriangleMesh;
use crate::geometry::Coordinate;

/// Whether a mesh is the boundary of something.
///
/// Vertices at the same position are taken as one, so a mesh of triangles that share no vertices
/// can be closed. A triangle with two corners at one position is left out: it has no inside, and
/// two of its edges are the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Closure {
    /// Some edge belongs to an odd number of triangles.
    Open,
    /// Every edge belongs to an even number of triangles, so that every line crosses the surface an
    /// even number of times. Triangles run along some edge more often one way than the other.
    Closed,
    /// Every edge belongs to as many triangles that run along it one way as the other way: closed,
    /// and each part faces either out or in.
    Oriented,
}

impl Closure {
    /// Says which `mesh` is. Takes 36 bytes a triangle while it works, and 8 a vertex. On this thread alone:
    /// others may wait for the answer, which is kept, and a thread of theirs must not take up their work meanwhile.
    pub fn of<T: Coordinate>(mesh: &TriangleMesh<T>) -> Self {
        let names = names_of_positions(mesh);
        let mut edges = Vec::with_capacity(3 * mesh.triangles().len());
        for triangle in mesh.triangles() {
            let [a, b, c] = triangle.map(|vertex| names[vertex as usize]);
            if a != b && b != c && c != a {
                edges.extend([(a, b), (b, c), (c, a)].map(directed));
            }
        }
        edges.sort_unstable();
        let uses = edges.chunk_by(|(one, _), (other, _)| one == other);
        let mut closure = Self::Oriented;
        for edge in uses {
            let rising = edge.iter().filter(|(_, rising)| *rising).count();
            if edge.len() % 2 == 1 {
                return Self::Open;
            }
            if 2 * rising != edge.len() {
                closure = Self::Closed;
            }
        }
        closure
    }

    /// Whether every edge belongs to an even number of triangles.
    pub fn is_closed(self) -> bool {
        self != Self::Open
    }
}

/// An edge, and whether it is run along from the lower name to the higher one.
fn directed((from, to): (u32, u32)) -> ((u32, u32), bool) {
    ((from.min(to), from.max(to)), from < to)
}

/// A number for each vertex that those at the same position share.
fn names_of_positions<T: Coordinate>(mesh: &TriangleMesh<T>) -> Vec<u32> {
    let position = |vertex: u32| mesh.vertices()[vertex as usize].map(T::bits);
    let mut order: Vec<u32> = (0..mesh.vertices().len() as u32).collect();
    order.sort_unstable_by_key(|&vertex| position(vertex));
    let mut names = vec![0; order.len()];
    for same in order.chunk_by(|&one, &other| position(one) == position(other)) {
        for &vertex in same {
            names[vertex as usize] = same[0];
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [[f32; 3]; 4] =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    const FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

    fn closure(faces: &[[u32; 3]]) -> Closure {
        let soup = faces.iter().map(|face| face.map(|vertex| CORNERS[vertex as usize]));
        Closure::of(&TriangleMesh::from_soup(soup).expect("the mesh is finite"))
    }

    #[test]
    fn a_tetrahedron_is_oriented_whether_its_vertices_are_shared_or_not() {
        let shared = TriangleMesh::new(CORNERS.to_vec(), FACES.to_vec()).expect("it is finite");
        assert_eq!(Closure::of(&shared), Closure::Oriented);
        assert_eq!(closure(&FACES), Closure::Oriented);
        assert_eq!(closure(&[]), Closure::Oriented);
    }

    #[test]
    fn a_face_that_is_missing_opens_it_and_one_that_is_turned_does_not() {
        assert_eq!(closure(&FACES[..3]), Closure::Open);
        let mut turned = FACES;
        turned[2].swap(0, 1);
        assert_eq!(closure(&turned), Closure::Closed);
        let all_turned = FACES.map(|[a, b, c]| [b, a, c]);
        assert_eq!(closure(&all_turned), Closure::Oriented);
    }

    #[test]
    fn the_two_zeros_are_one_place() {
        let mut vertices = CORNERS.to_vec();
        vertices.push([-0.0; 3]);
        let faces = [[4, 2, 1], [0, 1, 3], [4, 3, 2], [1, 2, 3]];
        let mesh = TriangleMesh::new(vertices, faces.to_vec()).expect("it is finite");
        assert_eq!(Closure::of(&mesh), Closure::Oriented);
    }

    #[test]
    fn triangles_with_two_corners_at_one_place_are_left_out() {
        let mut faces = FACES.to_vec();
        faces.extend([[0, 1, 1], [2, 2, 2]]);
        assert_eq!(closure(&faces), Closure::Oriented);
    }

    #[test]
    fn a_sheet_that_stands_twice_is_closed() {
        assert_eq!(closure(&[[0, 1, 2], [0, 1, 2]]), Closure::Closed);
        assert_eq!(closure(&[[0, 1, 2], [0, 2, 1]]), Closure::Oriented);
    }
}
