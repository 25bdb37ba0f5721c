//! Rays that share a point or a direction, answered in packets.

use kdray::geometry::Common;
use kdray::primitives::HitArrays;
use kdray::{PacketWork, Ray, RayPacket, Scene};

/// Rays that share a point or a direction, side by side, with room for their answers.
pub(crate) struct Bundle {
    common: Common,
    each: [Vec<f64>; 3],
    hits: HitArrays,
    is_hit: Vec<bool>,
}

impl Default for Bundle {
    fn default() -> Self {
        let (common, each) = (Common::Origin([0.0; 3]), Default::default());
        Self { common, each, hits: HitArrays::default(), is_hit: Vec::new() }
    }
}

impl Bundle {
    /// Replaces all rays by those, which share `common`.
    pub(crate) fn fill<'a>(&mut self, common: Common, rays: impl Iterator<Item = &'a Ray>) {
        self.common = common;
        self.each.iter_mut().for_each(Vec::clear);
        for ray in rays {
            let own = match common {
                Common::Origin(_) => ray.direction,
                Common::Direction(_) | Common::Target(_) => ray.origin,
            };
            self.each.iter_mut().zip(own).for_each(|(numbers, number)| numbers.push(number));
        }
    }

    /// The closest hits of the rays for t from 0 to `t_max`, and what they took.
    pub(crate) fn closest_hits(&mut self, scene: &Scene, t_max: f64) -> (&HitArrays, PacketWork) {
        let Self { common, each: [x, y, z], hits, .. } = self;
        let packet = RayPacket::new(*common, [x, y, z]).with_interval(0.0, t_max);
        let work = scene.packet_closest_hits(&packet, hits);
        (hits, work)
    }

    /// Whether each of the rays hits anything for t from 0 to `t_max`.
    pub(crate) fn any_hits(&mut self, scene: &Scene, t_max: f64) -> &[bool] {
        let Self { common, each: [x, y, z], is_hit, .. } = self;
        let packet = RayPacket::new(*common, [x, y, z]).with_interval(0.0, t_max);
        is_hit.resize(packet.len(), false);
        scene.packet_any_hits(&packet, is_hit);
        is_hit
    }
}
