//! All hits at once.

use super::{Precision, Scene};
use crate::geometry::Ray;
use crate::primitives::Hit;
use crate::traverse::wide::{All, Count, NoAim, search_along};
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
    /// mesh it is even for a ray from outside without end, and odd for one from inside, unless the direction is so
    /// short that some t is beyond f64.
    #[must_use]
    pub fn count(&self, ray: &Ray) -> usize {
        T::crossed(self, ray).len()
    }

    /// [`count`](Self::count) of each ray, on this thread: `counts[i]` is that of `rays[i]`. In turns,
    /// like [`closest_hits`](Self::closest_hits).
    ///
    /// # Panics
    /// If the slices differ in length.
    pub fn counts(&self, rays: &[Ray], counts: &mut [usize]) {
        assert_eq!(rays.len(), counts.len(), "as many counts as rays");
        T::counts(self, rays, counts);
    }

    /// [`counts`](Self::counts) on all threads of the current rayon pool.
    ///
    /// # Panics
    /// If the slices differ in length.
    #[cfg(feature = "rayon")]
    pub fn par_counts(&self, rays: &[Ray], counts: &mut [usize]) {
        assert_eq!(rays.len(), counts.len(), "as many counts as rays");
        super::batch::par_chunks(rays, counts, |rays, counts| self.counts(rays, counts));
    }

    /// Streams rays like [`each_closest_hit`](Self::each_closest_hit), and gives `found` all hits of
    /// each, as [`all_hits_into`](Self::all_hits_into) has them.
    pub fn each_all_hits(
        &self,
        rays: impl IntoIterator<Item: Borrow<Ray>>,
        mut found: impl FnMut(usize, &[Hit]),
    ) {
        let one = |ray: &Ray| {
            let mut hits = Vec::new();
            self.all_hits_into(ray, &mut hits);
            hits
        };
        self.each::<All<'_, T>>(rays, one, |index, hits| found(index, hits));
    }

    /// Streams rays like [`each_closest_hit`](Self::each_closest_hit), and gives `found` the
    /// [`count`](Self::count) of each.
    pub fn each_count(
        &self,
        rays: impl IntoIterator<Item: Borrow<Ray>>,
        mut found: impl FnMut(usize, usize),
    ) {
        let one = |ray: &Ray| T::crossed(self, ray);
        self.each::<Count<'_, T>>(rays, one, |index, ids| found(index, ids.len()));
    }

    /// What [`Precision`] compiles: the triangles that the ray crosses, each once.
    pub(super) fn find_crossed(&self, ray: &Ray) -> Vec<u32> {
        let by_walk = || self.all_hits(ray).map(|hit| hit.primitive_id).collect();
        let Some(tree) = self.wide_and_mesh() else { return by_walk() };
        let mut ids = Vec::new();
        match search_along::<Count<'_, T>>(tree, ray, self.instructions, &mut ids) {
            Ok(()) | Err(NoAim::Missed) => ids,
            Err(NoAim::OutOfRange) => by_walk(),
        }
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
