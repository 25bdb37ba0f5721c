//! What the scenes of the library have in common: answers to rays, block by block.

use kdray::query::Precision;
use kdray::{Hit, InstanceHit, InstancedScene, Ray, Scene};

/// Something that rays are cast at.
pub(crate) trait Cast: Sync {
    /// Gives `found` the closest hit of each ray, by its index. `hits` is room to work in.
    fn closest(
        &self,
        rays: &[Ray],
        hits: &mut Vec<Option<Hit>>,
        found: impl FnMut(usize, Option<Found>),
    );

    /// Whether each ray has any hit.
    fn any(&self, rays: &[Ray], found: &mut [bool]);

    /// How many surfaces each ray crosses.
    fn counts(&self, rays: &[Ray], counts: &mut [usize]);

    /// Gives `found` all hits of a ray in order. `hits` is room to work in.
    fn all(&self, ray: &Ray, hits: &mut Vec<Hit>, found: impl FnMut(Found));
}

/// A hit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    pub(crate) hit: Hit,
    /// The ids of the instance and of its geometry, where there are any.
    pub(crate) instance: Option<(u32, u32)>,
}

impl From<Hit> for Found {
    fn from(hit: Hit) -> Self {
        Self { hit, instance: None }
    }
}

impl From<InstanceHit> for Found {
    fn from(found: InstanceHit) -> Self {
        Self { hit: found.hit, instance: Some((found.instance_id, found.geometry_id)) }
    }
}

impl<T: Precision> Cast for Scene<T> {
    fn closest(
        &self,
        rays: &[Ray],
        hits: &mut Vec<Option<Hit>>,
        mut found: impl FnMut(usize, Option<Found>),
    ) {
        hits.clear();
        hits.resize(rays.len(), None);
        self.closest_hits(rays, hits);
        hits.iter().enumerate().for_each(|(i, hit)| found(i, hit.map(Found::from)));
    }

    fn any(&self, rays: &[Ray], found: &mut [bool]) {
        self.any_hits(rays, found);
    }

    fn counts(&self, rays: &[Ray], counts: &mut [usize]) {
        Self::counts(self, rays, counts);
    }

    fn all(&self, ray: &Ray, hits: &mut Vec<Hit>, mut found: impl FnMut(Found)) {
        self.all_hits_into(ray, hits);
        hits.iter().for_each(|&hit| found(hit.into()));
    }
}

impl<T: Precision> Cast for InstancedScene<T> {
    fn closest(
        &self,
        rays: &[Ray],
        _: &mut Vec<Option<Hit>>,
        mut found: impl FnMut(usize, Option<Found>),
    ) {
        let mut hits = vec![None; rays.len()];
        self.closest_hits(rays, &mut hits);
        hits.iter().enumerate().for_each(|(i, hit)| found(i, hit.map(Found::from)));
    }

    fn any(&self, rays: &[Ray], found: &mut [bool]) {
        self.any_hits(rays, found);
    }

    fn counts(&self, rays: &[Ray], counts: &mut [usize]) {
        rays.iter().zip(counts).for_each(|(ray, count)| *count = self.count(ray));
    }

    fn all(&self, ray: &Ray, _: &mut Vec<Hit>, mut found: impl FnMut(Found)) {
        let mut hits = Vec::new();
        self.all_hits_into(ray, &mut hits);
        hits.into_iter().for_each(|hit| found(hit.into()));
    }
}
