//! Which primitives a packet has met lately, so that it tests none twice (Amanatides & Woo 1987).

use super::lanes::LaneMask;

/// Slots by the low bits of a primitive's id: two primitives of one slot push each other out, which
/// costs a test and nothing else.
#[derive(Clone, Debug)]
pub(super) struct Mailbox {
    slots: [(u32, LaneMask); 64],
}

impl Mailbox {
    pub(super) fn new() -> Self {
        Self { slots: [(0, LaneMask::NONE); 64] }
    }

    /// Which of `lanes` have not met the primitive; now they have.
    pub(super) fn unmet(&mut self, id: u32, lanes: LaneMask) -> LaneMask {
        let slot = &mut self.slots[id as usize % 64];
        let met = if slot.0 == id { slot.1 } else { LaneMask::NONE };
        *slot = (id, met.with(lanes));
        lanes.without(met)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lane_meets_a_primitive_once() {
        let mut mailbox = Mailbox::new();
        let lanes = LaneMask;
        assert_eq!(mailbox.unmet(0, lanes(0b011)), lanes(0b011));
        assert_eq!(mailbox.unmet(0, lanes(0b110)), lanes(0b100));
        assert_eq!(mailbox.unmet(64, lanes(0b001)), lanes(0b001), "another one of its slot");
        assert_eq!(mailbox.unmet(0, lanes(0b001)), lanes(0b001), "forgotten, and so met again");
    }
}
