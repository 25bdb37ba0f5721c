//! Rays that are asked about together.

use crate::OwnedPacket;
use kdray::Ray;

/// How many rays most volleys have: a packet of the kernels.
pub const SIZE: usize = 64;

/// Some rays at one target.
#[derive(Clone, Debug)]
pub struct Volley {
    /// The rays.
    pub rays: Vec<Ray>,
    /// The same as a packet, if they share an origin, a direction or a target.
    pub packet: Option<OwnedPacket>,
    /// Whether all rays are known to begin in the inside of a closed mesh.
    pub from_inside: bool,
    /// Whether it is also put to who is slow: every triangle without a tree, and the packets that can be watched.
    pub to_the_slow: bool,
}

impl Volley {
    /// Rays that share nothing.
    pub fn of_rays(rays: Vec<Ray>) -> Self {
        Self { rays, packet: None, from_inside: false, to_the_slow: true }
    }

    /// The rays of a packet.
    pub fn of_packet(packet: OwnedPacket) -> Self {
        Self { rays: packet.rays(), packet: Some(packet), from_inside: false, to_the_slow: true }
    }

    /// Only the rays of these numbers.
    #[must_use]
    pub fn only(&self, indices: &[usize]) -> Self {
        Self {
            rays: indices.iter().map(|&index| self.rays[index]).collect(),
            packet: self.packet.as_ref().map(|packet| packet.only(indices)),
            from_inside: self.from_inside,
            to_the_slow: self.to_the_slow,
        }
    }
}
