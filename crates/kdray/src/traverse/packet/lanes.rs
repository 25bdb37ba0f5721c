//! Eight lanes, as a vector has, and sets of them.

use crate::geometry::Interval;

/// How many lanes a packet has at most.
pub(super) const LANES: usize = 8;

/// A set of lanes, a bit each, lane 0 the lowest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LaneMask(pub(super) u8);

impl LaneMask {
    /// No lane.
    pub const NONE: Self = Self(0);

    /// Whether there is no lane.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// How many lanes there are.
    pub fn count(self) -> u32 {
        self.0.count_ones()
    }

    /// The numbers of the lanes.
    pub fn lanes(self) -> impl Iterator<Item = usize> {
        (0..LANES).filter(move |lane| self.0 >> lane & 1 == 1)
    }

    pub(super) fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    pub(super) fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }
}

/// Where in a node each lane's rays may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Inside(pub(super) [Interval; LANES]);

impl Inside {
    /// The lanes that are in the node.
    pub(super) fn lanes(&self) -> LaneMask {
        let bits = (0..LANES).filter(|&lane| !self.0[lane].is_empty());
        LaneMask(bits.fold(0, |mask, lane| mask | 1 << lane))
    }

    /// From the least t_near to the greatest t_far.
    pub(super) fn hull(&self) -> Interval {
        self.0.iter().copied().fold(Interval::EMPTY, Interval::union)
    }
}
