//! All hits at once.

use super::{Precision, Scene};
use crate::geometry::Ray;
use crate::primitives::Hit;
use crate::traverse::wide::{All, NoAim, search_along};
use std::borrow::Borrow;

impl<T: Precision> Scene<T> {
    /// Replaces `hits` by all that [`all_hits`](Self::all_hits) gives: every crossing of a surface, once, by
    /// rising t. Several times as fast where all are wanted; who stops early, or may have more hits than
    /// memory, takes the iterator. Exact by either [`Arithmetic`](super::Arithmetic).
    ///
    /// ```
    /// # use kdray::{BuildOptions, Ray, Scene, TriangleMesh};
    /// # let sheet = |z: f32| [[0.0, 0.0, z], [1.0, 0.0, z], [0.0, 1.0, z]];
    /// # let mesh = TriangleMesh::from_soup([sheet(5.0), sheet(2.0)])?;
    /// # let scene = Scene::build(mesh, &BuildOptions::default())?;
    /// let mut hits = Vec::new();
    /// scene.all_hits_into(&Ray::new([0.25, 0.25, 0.0], [0.0, 0.0, 1.0]), &mut hits);
    /// assert_eq!(hits.iter().map(|hit| hit.t).collect::<Vec<_>>(), [2.0, 5.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn all_hits_into(&self, ray: &Ray, hits: &mut Vec<Hit>) {
        hits.clear();
        T::all_hits_into(self, ray, hits);
    }

    /// How many surfaces the ray crosses: the number of [`all_hits`](Self::all_hits). On a closed
    /// mesh it is even for a ray from outside without end, and odd for one from inside.
    #[must_use]
    pub fn count(&self, ray: &Ray) -> usize {
        let mut hits = Vec::new();
        T::all_hits_into(self, ray, &mut hits);
        hits.len()
    }

    /// Streams rays like [`each_closest_hit`](Self::each_closest_hit), and gives `found` all hits of
    /// each, as [`all_hits_into`](Self::all_hits_into) has them.
    pub fn each_all_hits(
        &self,
        rays: impl IntoIterator<Item: Borrow<Ray>>,
        found: impl FnMut(usize, Vec<Hit>),
    ) {
        let one = |ray: &Ray| {
            let mut hits = Vec::new();
            self.all_hits_into(ray, &mut hits);
            hits
        };
        self.each::<All<'_, T>>(rays, one, found);
    }

    /// What [`Precision`] compiles; `hits` are empty.
    pub(super) fn find_all_hits(&self, ray: &Ray, hits: &mut Vec<Hit>) {
        let Some(tree) = self.wide_and_mesh() else { return hits.extend(self.all_hits(ray)) };
        if let Err(NoAim::OutOfRange) =
            search_along::<All<'_, T>>(tree, ray, self.instructions, hits)
        {
            hits.extend(self.all_hits(ray));
        }
    }
}
