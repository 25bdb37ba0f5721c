//! Whether two points see each other.

use super::{Precision, Scene};
use crate::traverse;

impl<T: Precision> Scene<T> {
    /// Whether nothing is strictly between two points: no triangle has them on opposite sides of
    /// its plane and is met, be it at an edge or a vertex, by the line between them.
    ///
    /// So a surface that one of the points lies on is not in the way, nor is a triangle that the
    /// line runs in. This is exact for all f64: a point one unit in the last place behind a surface
    /// does not see what is before it. A point sees itself. Points that are not finite, or so far
    /// apart that their difference is not, see nothing.
    ///
    /// ```
    /// # use kdray::{BuildOptions, Scene, TriangleMesh};
    /// let corners = vec![[0.0, 0.0, 2.0], [4.0, 0.0, 2.0], [0.0, 4.0, 2.0]];
    /// let scene = Scene::build(TriangleMesh::new(corners, vec![[0, 1, 2]])?, &Default::default())?;
    /// assert!(!scene.visible([1.0, 1.0, 0.0], [1.0, 1.0, 3.0]));
    /// assert!(scene.visible([1.0, 1.0, 0.0], [1.0, 1.0, 2.0])); // on the triangle
    /// assert!(!scene.visible([1.0, 1.0, 0.0], [1.0, 1.0, 2.0_f64.next_up()]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn visible(&self, from: [f64; 3], to: [f64; 3]) -> bool {
        T::visible(self, from, to)
    }

    /// What [`Precision`] compiles.
    pub(super) fn finds_visible(&self, from: [f64; 3], to: [f64; 3]) -> bool {
        traverse::is_visible(self.tree(), self.mesh(), from, to)
    }
}
