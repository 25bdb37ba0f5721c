//! Rays that start where others hit.

use super::{Arithmetic, Precision, Scene};
use crate::geometry::Ray;
use crate::layout::Hint;
use crate::primitives::Hit;
use crate::traverse::wide::{Any, Located, Near, NoAim, search_along, search_near};

impl<T: Precision> Scene<T> {
    /// [`closest_hit`](Self::closest_hit), and where in the tree it was found: the hint for rays that
    /// start there and ask for [`any_hit_near`](Self::any_hit_near).
    #[must_use]
    pub fn closest_hit_with_hint(&self, ray: &Ray) -> Option<(Hit, Hint)> {
        T::closest_hit_with_hint(self, ray)
    }

    /// [`any_hit`](Self::any_hit) for a ray that starts at the hit that `hint` came with. The same answer
    /// as without, sooner: short rays and shadow rays take a fifth less time one by one; in batches it
    /// hardly matters. (By [`Arithmetic::Float`], of rays that it may get wrong, either answer.)
    ///
    /// ```
    /// # use kdray::{BuildOptions, Ray, Scene, TriangleMesh};
    /// # let corners = vec![[0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]];
    /// # let scene = Scene::build(TriangleMesh::new(corners, vec![[0, 1, 2]])?, &Default::default())?;
    /// let ray = Ray::new([0.25, 0.25, 0.0], [0.0, 0.0, 1.0]);
    /// let (hit, hint) = scene.closest_hit_with_hint(&ray).expect("the ray points at the triangle");
    /// let light = Ray::new([0.25, 0.25, hit.t - 1e-6], [0.0, 1.0, -1.0]);
    /// assert_eq!(scene.any_hit_near(&light, hint), scene.any_hit(&light));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn any_hit_near(&self, ray: &Ray, hint: Hint) -> bool {
        T::any_hit_near(self, ray, hint)
    }

    /// [`any_hit_near`](Self::any_hit_near) of each ray, on this thread: `found[i]` is that of `rays[i]`
    /// near `hints[i]`. Allocates nothing, unless
    /// called within another batch.
    ///
    /// # Panics
    /// If the slices differ in length.
    pub fn any_hits_near(&self, rays: &[Ray], hints: &[Hint], found: &mut [bool]) {
        assert_eq!(rays.len(), found.len(), "as many answers as rays");
        assert_eq!(rays.len(), hints.len(), "as many hints as rays");
        T::any_hits_near(self, rays, hints, found);
    }
}

/// What [`Precision`] compiles.
impl<T: Precision> Scene<T> {
    pub(super) fn find_closest_hit_with_hint(&self, ray: &Ray) -> Option<(Hit, Hint)> {
        let unhinted = || Some((self.trees.shapes.closest_hit(ray)?, Hint::NONE));
        let Some((tree, mesh)) = self.wide_and_mesh() else { return unhinted() };
        let mut found = None;
        let set = self.instructions;
        let searched = match self.arithmetic {
            Arithmetic::Float if T::FITS_TREE => {
                search_along::<Located<'_, T, false>>((tree, mesh), ray, set, &mut found)
            }
            _ => search_along::<Located<'_, T, true>>((tree, mesh), ray, set, &mut found),
        };
        if let Err(NoAim::OutOfRange) = searched {
            return unhinted();
        }
        let (hit, block) = found?;
        Some((hit, block.map_or(Hint::NONE, |block| tree.hint(block))))
    }

    pub(super) fn find_any_hit_near(&self, ray: &Ray, hint: Hint) -> bool {
        let Some(tree) = self.wide_and_mesh() else { return self.trees.shapes.any_hit(ray) };
        let mut is_hit = false;
        let set = self.instructions;
        let found = match self.arithmetic {
            Arithmetic::Float if T::FITS_TREE => {
                search_near::<Any<'_, T, false>>(tree, ray, hint, set, &mut is_hit)
            }
            _ => search_near::<Any<'_, T, true>>(tree, ray, hint, set, &mut is_hit),
        };
        match found {
            Ok(()) | Err(NoAim::Missed) => is_hit,
            Err(NoAim::OutOfRange) => self.trees.shapes.any_hit(ray),
        }
    }

    pub(super) fn find_any_hits_near(&self, rays: &[Ray], hints: &[Hint], found: &mut [bool]) {
        let rays = rays.iter().zip(hints).map(|(ray, &hint)| Near(ray, hint));
        self.each_any(rays, |index, is_hit| found[index] = is_hit);
    }
}
