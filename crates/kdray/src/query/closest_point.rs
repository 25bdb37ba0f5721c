//! The nearest point of the mesh.

use super::{Precision, Scene, points};
use crate::primitives::ClosestPoint;
use crate::traverse;

impl<T: Precision> Scene<T> {
    /// The point of the mesh that is nearest to `point`; of several at the same distance, the one
    /// of the smallest primitive id. `None` for an empty mesh, or a point that is not finite.
    ///
    /// Triangles without area count as the segments or points that they are, although no ray hits
    /// them. The distance is zero exactly where `point` is on the surface; elsewhere it errs as
    /// [`ClosestPoint::distance`] says. It is the same for every tree. From farther than some 2^45
    /// times the size of the mesh all triangles are at nearly the same distance, and all are looked
    /// at.
    ///
    /// ```
    /// # use kdray::{BuildOptions, Scene, TriangleMesh};
    /// let corners = vec![[0.0, 0.0, 2.0], [4.0, 0.0, 2.0], [0.0, 4.0, 2.0]];
    /// let scene = Scene::build(TriangleMesh::new(corners, vec![[0, 1, 2]])?, &Default::default())?;
    /// let nearest = scene.closest_point([1.0, 2.0, 5.0]).expect("the mesh has a triangle");
    /// assert_eq!((nearest.point, nearest.distance), ([1.0, 2.0, 2.0], 3.0));
    /// assert_eq!((nearest.primitive_id, nearest.u, nearest.v), (0, 0.25, 0.5));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn closest_point(&self, point: [f64; 3]) -> Option<ClosestPoint> {
        T::closest_point(self, point)
    }

    /// [`closest_point`](Self::closest_point) of each point, on this thread: `nearest[i]` is that
    /// of `points[i]`.
    ///
    /// # Panics
    /// If the slices differ in length.
    pub fn closest_points(&self, points: &[[f64; 3]], nearest: &mut [Option<ClosestPoint>]) {
        points::each(points, nearest, |point| self.closest_point(point));
    }

    /// [`closest_points`](Self::closest_points) on all threads of the current rayon pool.
    ///
    /// # Panics
    /// If the slices differ in length.
    #[cfg(feature = "rayon")]
    pub fn par_closest_points(&self, points: &[[f64; 3]], nearest: &mut [Option<ClosestPoint>]) {
        points::par_each(points, nearest, |point| self.closest_point(point));
    }

    /// What [`Precision`] compiles.
    pub(super) fn find_closest_point(&self, point: [f64; 3]) -> Option<ClosestPoint> {
        traverse::closest_point(self.tree(), self.wide_tree(), self.mesh(), point)
    }
}
