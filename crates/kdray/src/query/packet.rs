//! Rays that share an origin, a direction or a target (S12).

use super::{Precision, Scene};
use crate::geometry::RayPacket;
use crate::layout::WideTree;
use crate::primitives::{Hit, HitArrays};
use crate::simd::InstructionSet;
use crate::traverse::wide::packet::{Answers, PacketWork, Packets, Scratch};

impl<T: Precision> Scene<T> {
    /// [`closest_hit`](Self::closest_hit) of each ray of a packet, on this thread: `hits.get(i)` is that
    /// of `packet.ray(i)`, to the last bit. What it took comes back.
    ///
    /// Rays are taken in their order, 64 or 512 at a time, and bounded by a frustum, which is
    /// considered first: so they should lie next to each other, tile by tile. Where that does not pay,
    /// and for rays to a target, they are traced like those of [`closest_hits`](Self::closest_hits). So
    /// are all rays at f64 vertices. By [`Arithmetic::Float`](super::Arithmetic::Float) only what packets answer
    /// is exact: it is left open which rays that is.
    pub fn packet_closest_hits(&self, packet: &RayPacket<'_>, hits: &mut HitArrays) -> PacketWork {
        T::packet_closest_hits(self, packet, hits)
    }

    pub(super) fn find_packet_closest_hits(
        &self,
        packet: &RayPacket<'_>,
        hits: &mut HitArrays,
    ) -> PacketWork {
        hits.resize(packet.len());
        let mut left = Vec::new();
        let answers = Answers::Closest(hits);
        let work = self.in_packets::<false>(packet, answers, &mut left);
        let rays = left.iter().map(|&index| packet.ray(index as usize));
        self.each_closest_hit(rays, |place, hit: Option<Hit>| hits.set(left[place] as usize, hit));
        work
    }

    /// [`any_hit`](Self::any_hit) of each ray of a packet, on this thread: `found[i]` is that of
    /// `packet.ray(i)`. What it took comes back. See [`packet_closest_hits`](Self::packet_closest_hits).
    ///
    /// # Panics
    /// If there are not as many answers as rays.
    pub fn packet_any_hits(&self, packet: &RayPacket<'_>, found: &mut [bool]) -> PacketWork {
        assert_eq!(packet.len(), found.len(), "as many answers as rays");
        T::packet_any_hits(self, packet, found)
    }

    pub(super) fn find_packet_any_hits(
        &self,
        packet: &RayPacket<'_>,
        found: &mut [bool],
    ) -> PacketWork {
        let mut left = Vec::new();
        let answers = Answers::Any(found);
        let work = self.in_packets::<true>(packet, answers, &mut left);
        let rays = left.iter().map(|&index| packet.ray(index as usize));
        self.each_any_hit(rays, |place, is_hit| found[left[place] as usize] = is_hit);
        work
    }

    /// Answers the rays that packets pay for; the others are `left`.
    fn in_packets<const ANY: bool>(
        &self,
        packet: &RayPacket<'_>,
        answers: Answers<'_>,
        left: &mut Vec<u32>,
    ) -> PacketWork {
        let tree = if T::FITS_TREE { self.wide_tree() } else { None };
        match tree {
            Some(tree) => in_packets::<ANY>(tree, self.instructions, packet, answers, left),
            None => {
                left.extend(0..packet.len() as u32);
                PacketWork { left: packet.len(), ..PacketWork::default() }
            }
        }
    }
}

/// The same of a tree whose blocks hold the corners as they are in the mesh. Apart, so that it is compiled
/// once.
fn in_packets<const ANY: bool>(
    tree: &WideTree,
    instructions: InstructionSet,
    packet: &RayPacket<'_>,
    answers: Answers<'_>,
    left: &mut Vec<u32>,
) -> PacketWork {
    Scratch::of_thread(|scratch| {
        let kernel = Packets::<ANY> { tree, packet, answers, left, scratch };
        instructions.run(kernel)
    })
}
