//! Triangle meshes.

use super::{Hit, HitRule, Intersect, Primitives, intersect_triangle};
use crate::geometry::{
    Aabb, Coordinate, Ray, TreeSpace, bounds_of, clipped_bounds_of, inner_bounds_of,
    split_bounds_of,
};
use crate::memory::Store;
use thiserror::Error;

/// Triangles that share vertices: positions, and three indices into them a triangle.
///
/// Degenerate triangles are kept and never hit; duplicates are kept; an empty mesh is valid.
///
/// Positions are f32, or f64 if f32 would round them: the mesh's type is that of the numbers it is made
/// of, and a literal without a suffix is an f64. All of f64 will do, whatever the size of the mesh and
/// however far it is from zero; trees over such a mesh are in coordinates of their own
/// ([`tree_space`](Self::tree_space)).
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleMesh<T: 'static = f32> {
    vertices: Store<[T; 3]>,
    triangles: Store<[u32; 3]>,
    space: TreeSpace,
}

/// Why a mesh cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum MeshError {
    /// A triangle names a vertex that is not there.
    #[error(
        "triangle {triangle} uses vertex {vertex}, but there are only {vertices}; mend or drop the triangle"
    )]
    IndexOutOfRange {
        /// The index of the triangle.
        triangle: usize,
        /// The vertex index it holds.
        vertex: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A coordinate of one of the triangle's vertices is infinite or NaN.
    #[error("vertex {vertex} of triangle {triangle} is not finite; mend or drop the triangle")]
    NonFiniteVertex {
        /// The index of the triangle.
        triangle: usize,
        /// The vertex index it holds.
        vertex: u32,
    },
    /// There are 2^30 triangles or more.
    #[error("the mesh has {0} triangles, but at most 1073741823 fit one tree; split the mesh")]
    TooManyTriangles(usize),
    /// There are 2^32 vertices or more, which indices cannot number.
    #[error(
        "the mesh has {0} vertices, but at most 4294967295 fit one mesh; drop those that no triangle uses, or split the mesh"
    )]
    TooManyVertices(usize),
}

impl<T: Coordinate> TriangleMesh<T> {
    /// A mesh of `triangles` over `vertices`. Vertices that no triangle uses may be anything.
    ///
    /// # Errors
    /// The first triangle that has an index out of range or a vertex that is not finite; 2^30
    /// triangles or more, or 2^32 vertices or more.
    pub fn new(vertices: Vec<[T; 3]>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        check_counts(vertices.len(), triangles.len())?;
        for (index, triangle) in triangles.iter().enumerate() {
            check_triangle(&vertices, index, triangle)?;
        }
        let space = tree_space(&vertices, &triangles);
        Ok(Self { vertices: vertices.into(), triangles: triangles.into(), space })
    }

    /// Like [`new`](Self::new), but drops the triangles it would refuse, and returns the indices
    /// they had. The others keep their order; their ids close the gaps.
    ///
    /// # Errors
    /// Only that 2^30 triangles or more are left, or that there are 2^32 vertices or more.
    pub fn new_dropping_bad(
        vertices: Vec<[T; 3]>,
        mut triangles: Vec<[u32; 3]>,
    ) -> Result<(Self, Vec<usize>), MeshError> {
        let mut dropped = Vec::new();
        let mut index = 0;
        triangles.retain(|triangle| {
            let bad = check_triangle(&vertices, index, triangle).is_err();
            if bad {
                dropped.push(index);
            }
            index += 1;
            !bad
        });
        Ok((Self::new(vertices, triangles)?, dropped))
    }

    /// A mesh in which every triangle has three vertices of its own.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn from_soup<V: Into<[T; 3]>>(
        soup: impl IntoIterator<Item = [V; 3]>,
    ) -> Result<Self, MeshError> {
        let vertices: Vec<[T; 3]> = soup.into_iter().flatten().map(Into::into).collect();
        let count = vertices.len() / 3;
        check_counts(vertices.len(), count)?;
        let triangles = (0..count as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
        Self::new(vertices, triangles.collect())
    }

    /// The vertex positions.
    pub fn vertices(&self) -> &[[T; 3]] {
        &self.vertices
    }

    /// The vertex indices of each triangle.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The corners a, b, c of a triangle.
    ///
    /// # Panics
    /// If there is no triangle of that id.
    pub fn corners(&self, id: u32) -> [[T; 3]; 3] {
        let [a, b, c] = self.triangles[id as usize];
        [self.vertices[a as usize], self.vertices[b as usize], self.vertices[c as usize]]
    }

    /// (b−a) x (c−a) of a triangle: its normal, of twice its area in length.
    ///
    /// # Panics
    /// If there is no triangle of that id.
    pub fn geometric_normal(&self, id: u32) -> [f64; 3] {
        let [a, b, c] = self.corners(id).map(|p| glam::DVec3::from(p.map(T::to_f64)));
        (b - a).cross(c - a).into()
    }

    /// The coordinates that trees over this mesh are in: for f32 the mesh's own.
    pub fn tree_space(&self) -> &TreeSpace {
        &self.space
    }

    /// The corners of a triangle as the tree sees them.
    #[inline]
    fn tree_corners(&self, id: u32) -> [[T; 3]; 3] {
        let corners = self.corners(id);
        if T::FITS_TREE {
            return corners;
        }
        corners.map(|p| self.space.point(p.map(T::to_f64)).map(T::from_f64))
    }

    /// What every box around the part of a triangle in a cell of the tree holds: see [`inner_bounds_of`].
    pub(crate) fn inner_bounds(&self, id: u32, cell: &Aabb<3>) -> Option<Aabb<3>> {
        inner_bounds_of(&self.tree_corners(id), T::TREE_ERROR, cell)
    }

    /// The same, rounded to f32.
    pub(crate) fn rounded_corners(&self, id: u32) -> [[f32; 3]; 3] {
        self.tree_corners(id).map(|p| p.map(|x| x.to_f64() as f32))
    }
}

/// The coordinates of trees over these triangles.
fn tree_space<T: Coordinate>(vertices: &[[T; 3]], triangles: &[[u32; 3]]) -> TreeSpace {
    let (mut min, mut max) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    if !T::FITS_TREE {
        for position in triangles.iter().flatten().map(|&vertex| vertices[vertex as usize]) {
            for (k, x) in position.into_iter().enumerate() {
                (min[k], max[k]) = (min[k].min(x.to_f64()), max[k].max(x.to_f64()));
            }
        }
    }
    TreeSpace::around::<T>(min, max)
}

impl<T: Coordinate> Default for TriangleMesh<T> {
    fn default() -> Self {
        let (vertices, triangles) = (Store::default(), Store::default());
        Self { vertices, triangles, space: TreeSpace::OF_MESH }
    }
}

/// Meshes of tree files.
impl<T: Coordinate> TriangleMesh<T> {
    /// A mesh of arrays that come from a file, after the checks of [`new`](Self::new), which take less
    /// time where nothing is wrong.
    pub(crate) fn of_stores(
        vertices: Store<[T; 3]>,
        triangles: Store<[u32; 3]>,
    ) -> Result<Self, MeshError> {
        check_counts(vertices.len(), triangles.len())?;
        let largest = triangles.as_flattened().iter().fold(0, |largest, &index| index.max(largest));
        let finite =
            vertices.as_flattened().iter().fold(true, |all, x| all & x.to_f64().is_finite());
        // If not all is as it should be, perhaps what is wrong is not used.
        if !finite || largest as usize >= vertices.len() {
            let mut numbered = triangles.iter().enumerate();
            numbered
                .try_for_each(|(index, triangle)| check_triangle(&vertices, index, triangle))?;
        }
        let space = tree_space(&vertices, &triangles);
        Ok(Self { vertices, triangles, space })
    }

    /// The vertex positions, to be saved.
    pub(crate) fn vertex_store(&self) -> &Store<[T; 3]> {
        &self.vertices
    }

    /// The triangles, to be saved.
    pub(crate) fn triangle_store(&self) -> &Store<[u32; 3]> {
        &self.triangles
    }
}

/// Whether indices can number so many: those of a tree have 30 bits.
fn check_counts(vertices: usize, triangles: usize) -> Result<(), MeshError> {
    if triangles >= 1 << 30 {
        Err(MeshError::TooManyTriangles(triangles))
    } else if u32::try_from(vertices).is_err() {
        Err(MeshError::TooManyVertices(vertices))
    } else {
        Ok(())
    }
}

fn check_triangle<T: Coordinate>(
    vertices: &[[T; 3]],
    index: usize,
    triangle: &[u32; 3],
) -> Result<(), MeshError> {
    for &vertex in triangle {
        let Some(position) = vertices.get(vertex as usize) else {
            let vertices = vertices.len();
            return Err(MeshError::IndexOutOfRange { triangle: index, vertex, vertices });
        };
        if !position.iter().all(|x| x.to_f64().is_finite()) {
            return Err(MeshError::NonFiniteVertex { triangle: index, vertex });
        }
    }
    Ok(())
}

impl<T: Coordinate> Primitives<3> for TriangleMesh<T> {
    fn count(&self) -> usize {
        self.triangles.len()
    }

    fn bounds(&self, id: u32) -> Aabb<3> {
        bounds_of(&self.tree_corners(id), T::TREE_ERROR)
    }

    fn clipped_bounds(&self, id: u32, cell: &Aabb<3>) -> Option<Aabb<3>> {
        clipped_bounds_of(&self.tree_corners(id), T::TREE_ERROR, cell)
    }

    fn split_bounds(
        &self,
        id: u32,
        cell: &Aabb<3>,
        axis: usize,
        position: f32,
    ) -> [Option<Aabb<3>>; 2] {
        split_bounds_of(&self.tree_corners(id), T::TREE_ERROR, cell, axis, position)
    }

    #[inline]
    fn ray_in_tree(&self, ray: &Ray<3>) -> Option<Ray<3>> {
        if T::FITS_TREE { Some(*ray) } else { self.space.ray(ray) }
    }
}

impl<T: Coordinate> Intersect<3> for TriangleMesh<T> {
    #[inline]
    fn intersect(&self, id: u32, ray: &Ray<3>, rule: HitRule, report: &mut impl FnMut(Hit)) {
        if let Some(hit) = intersect_triangle(&self.corners(id), id, ray, rule) {
            report(hit);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [[f32; 3]; 3] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

    #[test]
    fn errors_name_the_triangle() {
        let out_of_range = TriangleMesh::new(CORNERS.to_vec(), vec![[0, 1, 2], [0, 1, 3]]);
        let expected = MeshError::IndexOutOfRange { triangle: 1, vertex: 3, vertices: 3 };
        assert_eq!(out_of_range, Err(expected));
        let mut vertices = CORNERS.to_vec();
        vertices.push([0.0, f32::NAN, 0.0]);
        assert!(TriangleMesh::new(vertices.clone(), vec![[0, 1, 2]]).is_ok(), "unused vertex");
        let nan = TriangleMesh::new(vertices, vec![[0, 1, 2], [3, 1, 2]]);
        assert_eq!(nan, Err(MeshError::NonFiniteVertex { triangle: 1, vertex: 3 }));
    }

    #[test]
    fn what_indices_cannot_number_is_refused() {
        let (vertices, triangles) = (u32::MAX as usize, (1 << 30) - 1);
        assert_eq!(check_counts(vertices, triangles), Ok(()));
        assert_eq!(
            check_counts(vertices, triangles + 1),
            Err(MeshError::TooManyTriangles(triangles + 1))
        );
        let Some(more) = vertices.checked_add(1) else { return };
        assert_eq!(check_counts(more, 1), Err(MeshError::TooManyVertices(more)));
    }

    #[test]
    fn bad_triangles_can_be_dropped_and_counted() {
        let triangles = vec![[0, 1, 9], [0, 1, 2], [7, 1, 2]];
        let (mesh, dropped) = TriangleMesh::new_dropping_bad(CORNERS.to_vec(), triangles).unwrap();
        assert_eq!((mesh.triangles().len(), dropped), (1, vec![0, 2]));
    }
}
