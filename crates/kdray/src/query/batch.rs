//! Many rays at once.

use super::{Arithmetic, Precision, Scene};
use crate::geometry::Ray;
use crate::primitives::Hit;
use crate::traverse::wide::{Any, Closest, Search, Start, search_along_each};
use std::borrow::Borrow;

impl<T: Precision> Scene<T> {
    /// [`closest_hit`](Self::closest_hit) of each ray, on this thread: `hits[i]` is that of
    /// `rays[i]`. Allocates nothing, unless called within another batch.
    ///
    /// From eight rays on faster than one ray after the other: sixteen are under way at once and take
    /// turns.
    ///
    /// # Panics
    /// If the slices differ in length.
    pub fn closest_hits(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        assert_eq!(rays.len(), hits.len(), "as many hits as rays");
        T::closest_hits(self, rays, hits);
    }

    /// [`any_hit`](Self::any_hit) of each ray, on this thread: `found[i]` is that of `rays[i]`.
    /// Allocates nothing, unless called within another batch.
    ///
    /// # Panics
    /// If the slices differ in length.
    pub fn any_hits(&self, rays: &[Ray], found: &mut [bool]) {
        assert_eq!(rays.len(), found.len(), "as many answers as rays");
        T::any_hits(self, rays, found);
    }

    /// [`closest_hits`](Self::closest_hits) on all threads of the current rayon pool.
    ///
    /// # Panics
    /// If the slices differ in length.
    #[cfg(feature = "rayon")]
    pub fn par_closest_hits(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        assert_eq!(rays.len(), hits.len(), "as many hits as rays");
        par_chunks(rays, hits, |rays, hits| self.closest_hits(rays, hits));
    }

    /// [`any_hits`](Self::any_hits) on all threads of the current rayon pool.
    ///
    /// # Panics
    /// If the slices differ in length.
    #[cfg(feature = "rayon")]
    pub fn par_any_hits(&self, rays: &[Ray], found: &mut [bool]) {
        assert_eq!(rays.len(), found.len(), "as many answers as rays");
        par_chunks(rays, found, |rays, found| self.any_hits(rays, found));
    }

    /// Streams rays: takes them from `rays` as it goes, and gives `found` the number of each ray,
    /// from zero, with its [`closest_hit`](Self::closest_hit). Answers come once each, in no
    /// particular order.
    ///
    /// ```
    /// # use kdray::{BuildOptions, Ray, Scene, TriangleMesh};
    /// # let corners = vec![[0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]];
    /// # let scene = Scene::build(TriangleMesh::new(corners, vec![[0, 1, 2]])?, &Default::default())?;
    /// let rays = (0..10).map(|i| Ray::new([0.25 * f64::from(i), 0.25, 0.0], [0.0, 0.0, 1.0]));
    /// let mut hits = 0;
    /// scene.each_closest_hit(rays, |_, hit| hits += usize::from(hit.is_some()));
    /// assert_eq!(hits, 4);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn each_closest_hit(
        &self,
        rays: impl IntoIterator<Item: Borrow<Ray>>,
        mut found: impl FnMut(usize, Option<Hit>),
    ) {
        let found = |index, hit: &mut Option<Hit>| found(index, *hit);
        let one = |ray: &Ray| self.closest_hit(ray);
        match self.arithmetic {
            Arithmetic::Float if T::FITS_TREE => {
                self.each::<Closest<'_, T, false>>(rays, one, found);
            }
            _ => self.each::<Closest<'_, T, true>>(rays, one, found),
        }
    }

    /// Streams rays like [`each_closest_hit`](Self::each_closest_hit), and tells whether each has
    /// [`any_hit`](Self::any_hit).
    pub fn each_any_hit(
        &self,
        rays: impl IntoIterator<Item: Borrow<Ray>>,
        found: impl FnMut(usize, bool),
    ) {
        self.each_any(rays, found);
    }

    pub(super) fn each_any(
        &self,
        rays: impl IntoIterator<Item: Start>,
        mut found: impl FnMut(usize, bool),
    ) {
        let found = |index, is_hit: &mut bool| found(index, *is_hit);
        let one = |ray: &Ray| self.any_hit(ray);
        match self.arithmetic {
            Arithmetic::Float if T::FITS_TREE => {
                self.each::<Any<'_, T, false>>(rays, one, found);
            }
            _ => self.each::<Any<'_, T, true>>(rays, one, found),
        }
    }

    /// Searches along each of `rays`: in turns, which was faster on trees of every size, unless they
    /// are so few that to begin with turns takes longer (measured: docs/decisions/0011).
    pub(super) fn each<'a, Q: Search<'a, Coordinate = T>>(
        &'a self,
        rays: impl IntoIterator<Item: Start>,
        one: impl Fn(&Ray) -> Q::Answer,
        mut found: impl FnMut(usize, &mut Q::Answer),
    ) {
        const ENOUGH: usize = 8;
        let rays = rays.into_iter();
        let few = rays.size_hint().1.is_some_and(|most| most < ENOUGH);
        match self.wide_and_mesh().filter(|_| !few) {
            Some(tree) => search_along_each::<Q>(tree, rays, self.instructions, one, found),
            None => rays.enumerate().for_each(|(index, ray)| found(index, &mut one(ray.ray()))),
        }
    }
}

/// Hands `rays` to several threads, with the room for their answers.
#[cfg(feature = "rayon")]
pub(super) fn par_chunks<T: Send>(
    rays: &[Ray],
    answers: &mut [T],
    answer: impl Fn(&[Ray], &mut [T]) + Sync,
) {
    use rayon::prelude::*;
    const CHUNK: usize = 4096;
    let chunks = rays.par_chunks(CHUNK).zip(answers.par_chunks_mut(CHUNK));
    chunks.for_each(|(rays, answers)| answer(rays, answers));
}
