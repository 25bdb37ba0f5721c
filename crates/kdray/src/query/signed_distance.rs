//! How deep inside, or how far outside.

use super::{Precision, Scene, points};

impl<T: Precision> Scene<T> {
    /// The distance from `point` to the mesh: negative inside, positive outside, zero on the
    /// surface. `None` for an empty mesh, or a point that is not finite.
    ///
    /// The size is that of [`closest_point`](Self::closest_point), the sign that of
    /// [`contains`](Self::contains).
    ///
    /// ```
    /// # use kdray::{BuildOptions, Scene, TriangleMesh};
    /// let corners = vec![[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]];
    /// let faces = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    /// let scene = Scene::build(TriangleMesh::new(corners, faces)?, &Default::default())?;
    /// assert_eq!(scene.signed_distance([0.5, 1.0, 1.0]), Some(-0.5));
    /// assert_eq!(scene.signed_distance([1.0, 0.0, 1.0]), Some(0.0));
    /// assert_eq!(scene.signed_distance([-2.0, 1.0, 1.0]), Some(2.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn signed_distance(&self, point: [f64; 3]) -> Option<f64> {
        T::signed_distance(self, point)
    }

    /// What [`Precision`] compiles.
    pub(super) fn find_signed_distance(&self, point: [f64; 3]) -> Option<f64> {
        let distance = self.find_closest_point(point)?.distance;
        let is_inside = distance > 0.0 && self.contains_off_surface(point);
        Some(if is_inside { -distance } else { distance })
    }

    /// [`signed_distance`](Self::signed_distance) of each point, on this thread: `distances[i]` is
    /// that of `points[i]`.
    ///
    /// # Panics
    /// If the slices differ in length.
    pub fn signed_distances(&self, points: &[[f64; 3]], distances: &mut [Option<f64>]) {
        points::each(points, distances, |point| self.signed_distance(point));
    }

    /// [`signed_distances`](Self::signed_distances) on all threads of the current rayon pool.
    ///
    /// # Panics
    /// If the slices differ in length.
    #[cfg(feature = "rayon")]
    pub fn par_signed_distances(&self, points: &[[f64; 3]], distances: &mut [Option<f64>]) {
        points::par_each(points, distances, |point| self.signed_distance(point));
    }
}
