//! Whether rays that share something go in packets or in a batch.
//!
//! Packets are several times as fast where many rays meet the same triangles, and slower where each meets others:
//! the library gives such packets up, after some work. Answers are the same.

use kdray::PacketWork;

/// After so many blocks in batches packets are tried again.
const AGAIN: usize = 16;

/// Packets pay if fewer than one ray of so many is left to the batch. (Measured on pictures of 10^5 and 10^6 rays: where
/// packets were slower 0.38 to 0.58 of the rays were left, where they were faster 0.003 to 0.18.)
const FEW_LEFT: usize = 3;

/// How many blocks are to go in batches.
#[derive(Debug, Default)]
pub(crate) struct Pace {
    batches: usize,
}

impl Pace {
    /// Takes the turn of the next block: whether it goes in packets.
    pub(crate) fn take_turn(&mut self) -> bool {
        let in_packets = self.batches == 0;
        self.batches = self.batches.saturating_sub(1);
        in_packets
    }

    /// Learns what the packets of so many rays were worth.
    pub(crate) fn learn(&mut self, work: &PacketWork, rays: usize) {
        if FEW_LEFT * work.left >= rays {
            self.batches = AGAIN;
        }
    }
}
