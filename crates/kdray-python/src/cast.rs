//! What the scenes of the library have in common: answers to rays, block by block.

use crate::columns::{Part, Real};
use crate::room::Room;
use kdray::query::Precision;
use kdray::{Hit, InstanceHit, InstancedScene, Ray, Scene};

/// Something that rays are cast at.
pub(crate) trait Cast: Sync {
    /// The closest hit of each ray.
    fn closest<F: Real>(&self, rays: &[Ray], room: &mut Room, found: &mut Part<'_, F>);

    /// Whether each ray has any hit.
    fn any(&self, rays: &[Ray], room: &mut Room, found: &mut [bool]);

    /// How many surfaces each ray crosses.
    fn counts(&self, rays: &[Ray], counts: &mut [usize]);

    /// Gives `found` the first hits of each ray in order, `limit` at most, with the index of their ray: those of the
    /// first ray first.
    fn all(&self, rays: &[Ray], limit: usize, room: &mut Room, found: impl FnMut(usize, Found));
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
    fn closest<F: Real>(&self, rays: &[Ray], room: &mut Room, found: &mut Part<'_, F>) {
        if let Some(common) = room.common::<T>(rays) {
            let (packet, order) = room.packet.of(common, rays);
            let work = self.packet_closest_hits(&packet, &mut room.of_packet);
            found.set_packet(order, &room.of_packet);
            room.pace().learn(&work, rays.len());
        } else {
            room.closest.resize(rays.len(), None);
            self.closest_hits(rays, &mut room.closest);
            found.set_each(room.closest.iter().map(|hit| hit.map(Found::from)));
        }
    }

    fn any(&self, rays: &[Ray], room: &mut Room, found: &mut [bool]) {
        let Some(common) = room.common::<T>(rays) else { return self.any_hits(rays, found) };
        let (packet, order) = room.packet.of(common, rays);
        room.any.resize(rays.len(), false);
        let work = self.packet_any_hits(&packet, &mut room.any);
        order.iter().zip(&room.any).for_each(|(&ray, &hit)| found[ray as usize] = hit);
        room.pace().learn(&work, rays.len());
    }

    fn counts(&self, rays: &[Ray], counts: &mut [usize]) {
        Self::counts(self, rays, counts);
    }

    fn all(
        &self,
        rays: &[Ray],
        limit: usize,
        room: &mut Room,
        mut found: impl FnMut(usize, Found),
    ) {
        let Room { all, places, .. } = room;
        all.clear();
        places.resize(rays.len(), 0..0);
        self.each_all_hits(rays, |index, hits| {
            let hits = &hits[..hits.len().min(limit)];
            places[index] = all.len()..all.len() + hits.len();
            all.extend_from_slice(hits);
        });
        for (index, place) in places.iter().enumerate() {
            all[place.clone()].iter().for_each(|&hit| found(index, hit.into()));
        }
    }
}

impl<T: Precision> Cast for InstancedScene<T> {
    fn closest<F: Real>(&self, rays: &[Ray], _: &mut Room, found: &mut Part<'_, F>) {
        let mut hits = vec![None; rays.len()];
        self.closest_hits(rays, &mut hits);
        found.set_each(hits.iter().map(|hit| hit.map(Found::from)));
    }

    fn any(&self, rays: &[Ray], _: &mut Room, found: &mut [bool]) {
        self.any_hits(rays, found);
    }

    fn counts(&self, rays: &[Ray], counts: &mut [usize]) {
        rays.iter().zip(counts).for_each(|(ray, count)| *count = self.count(ray));
    }

    fn all(&self, rays: &[Ray], limit: usize, _: &mut Room, mut found: impl FnMut(usize, Found)) {
        let mut hits = Vec::new();
        for (index, ray) in rays.iter().enumerate() {
            self.all_hits_into(ray, &mut hits);
            hits.iter().take(limit).for_each(|&hit| found(index, hit.into()));
        }
    }
}
