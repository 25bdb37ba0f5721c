//! Hits one by one: those that are wanted, and those that come after another.

use super::{Precision, Scene};
use crate::geometry::Ray;
use crate::primitives::{Hit, TriangleMesh};
use crate::traverse::AllHits;

impl<T: Precision> Scene<T> {
    /// The first hit that `keep` keeps: [`closest_hit`](Self::closest_hit) as if the others were not
    /// there. It is asked once of each hit, by rising t, equal t by rising primitive id, and no more
    /// when it has said yes; for instance by a mask of triangles.
    ///
    /// Goes by the scalar traversal and is exact, whatever the scene's
    /// [`Arithmetic`](super::Arithmetic).
    ///
    /// ```
    /// # use kdray::{BuildOptions, Ray, Scene, TriangleMesh};
    /// # let low = [[0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]];
    /// # let high = [[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [0.0, 1.0, 5.0]];
    /// # let mesh = TriangleMesh::from_soup([low, high])?;
    /// # let scene = Scene::build(mesh, &Default::default())?;
    /// let ray = Ray::new([0.25, 0.25, 0.0], [0.0, 0.0, 1.0]);
    /// let is_opaque = [false, true];
    /// let hit = scene.closest_hit_where(&ray, |hit| is_opaque[hit.primitive_id as usize]);
    /// assert_eq!(hit.expect("the second is opaque").t, 5.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn closest_hit_where(&self, ray: &Ray, keep: impl FnMut(&Hit) -> bool) -> Option<Hit> {
        self.shapes().closest_hit_where(ray, keep)
    }

    /// Whether `keep` keeps any hit; asked as by [`closest_hit_where`](Self::closest_hit_where).
    pub fn any_hit_where(&self, ray: &Ray, keep: impl FnMut(&Hit) -> bool) -> bool {
        self.closest_hit_where(ray, keep).is_some()
    }

    /// The crossings of [`all_hits`](Self::all_hits) that come after `last`, one of them; others at
    /// the same t are neither lost nor repeated. So hits can be taken a few at a time, without room
    /// for all, and without keeping the walk:
    ///
    /// ```
    /// # use kdray::{BuildOptions, Ray, Scene, TriangleMesh};
    /// # let sheet = [[0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]];
    /// # let scene = Scene::build(TriangleMesh::from_soup([sheet; 5])?, &Default::default())?;
    /// let ray = Ray::new([0.25, 0.25, 0.0], [0.0, 0.0, 1.0]);
    /// let few: Vec<_> = scene.all_hits(&ray).take(3).collect();
    /// let rest: Vec<_> = scene.all_hits_after(&ray, &few[2]).collect();
    /// assert_eq!((few.len(), rest.len()), (3, 2)); // all five at t = 2
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn all_hits_after(&self, ray: &Ray, last: &Hit) -> AllHits<'_, TriangleMesh<T>, 3> {
        self.shapes().all_hits_after(ray, last)
    }

    /// What [`all_touched`](Self::all_touched) finds after `last`, one of its hits.
    pub fn all_touched_after(&self, ray: &Ray, last: &Hit) -> AllHits<'_, TriangleMesh<T>, 3> {
        self.shapes().all_touched_after(ray, last)
    }
}
