//! All hits at once, and many rays, on instances.

use super::asked::Asked;
#[cfg(feature = "rayon")]
use super::batch::par_chunks;
use super::{InstanceHit, InstancedScene, Precision, Scene};
use crate::geometry::Ray;

impl<T: Precision> InstancedScene<T> {
    /// Replaces `hits` by all that [`all_hits`](Self::all_hits) gives. Several times as fast where all are
    /// wanted.
    pub fn all_hits_into(&self, ray: &Ray, hits: &mut Vec<InstanceHit>) {
        hits.clear();
        let mut found = Vec::new();
        self.each_met(ray, |id, geometry, carried| {
            geometry.all_hits_into(carried, &mut found);
            hits.extend(found.iter().map(|&hit| self.found(id, hit)));
        });
        hits.sort_unstable_by(InstanceHit::order);
    }

    /// How many surfaces the ray crosses: the number of [`all_hits`](Self::all_hits).
    #[must_use]
    pub fn count(&self, ray: &Ray) -> usize {
        let mut count = 0;
        self.each_met(ray, |_, geometry, carried| count += geometry.count(carried));
        count
    }

    /// Gives `ask` each instance whose box the ray may meet, once: its id, its geometry and the ray there.
    fn each_met(&self, ray: &Ray, mut ask: impl FnMut(u32, &Scene<T>, &Ray)) {
        let (mut walk, mut asked) = (self.walk(ray), Asked::default());
        while let Some(leaf) = walk.next_leaf(ray.interval.t_max, &mut ()) {
            for &id in leaf.primitives {
                if self.sees(id) && asked.is_new(id) {
                    let (geometry, carried) = self.carry(id, ray);
                    ask(id, geometry, &carried);
                }
            }
        }
    }

    /// [`closest_hit`](Self::closest_hit) of each ray, on this thread: `hits[i]` is that of `rays[i]`. Each
    /// ray is carried alone.
    ///
    /// # Panics
    /// If the slices differ in length.
    pub fn closest_hits(&self, rays: &[Ray], hits: &mut [Option<InstanceHit>]) {
        assert_eq!(rays.len(), hits.len(), "as many hits as rays");
        rays.iter().zip(hits).for_each(|(ray, hit)| *hit = self.closest_hit(ray));
    }

    /// [`any_hit`](Self::any_hit) of each ray, on this thread: `found[i]` is that of `rays[i]`.
    ///
    /// # Panics
    /// If the slices differ in length.
    pub fn any_hits(&self, rays: &[Ray], found: &mut [bool]) {
        assert_eq!(rays.len(), found.len(), "as many answers as rays");
        rays.iter().zip(found).for_each(|(ray, is_hit)| *is_hit = self.any_hit(ray));
    }

    /// [`closest_hits`](Self::closest_hits) on all threads of the current rayon pool.
    ///
    /// # Panics
    /// If the slices differ in length.
    #[cfg(feature = "rayon")]
    pub fn par_closest_hits(&self, rays: &[Ray], hits: &mut [Option<InstanceHit>]) {
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
}
