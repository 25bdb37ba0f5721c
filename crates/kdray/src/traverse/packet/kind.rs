//! The three ways to take rays together.

/// What is asked at a node on behalf of all rays of a packet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PacketKind {
    /// Eight rays, a lane each. Every lane has its own t_near and t_far, and a node is entered if
    /// any lane wants it (Wald, Slusallek, Benthin & Wagner 2001).
    Masked,
    /// Rays of common direction signs under one interval from the least t_near to the greatest
    /// t_far, by interval arithmetic over their origins and inverse directions (Reshetov, Soupikov &
    /// Hurley 2005; Boulos, Wald & Shirley 2006).
    Interval,
    /// Rays of a common origin, direction or end in eight sub-frusta, each a rectangle of slopes on
    /// the dominant axis between four corner rays (Reshetov, Soupikov & Hurley 2005; Wald, Boulos &
    /// Shirley 2007). Triangles are culled against the frusta before any ray is tested.
    Frustum,
}

impl PacketKind {
    /// All kinds, by how much a node's decision says at once.
    pub const ALL: [Self; 3] = [Self::Masked, Self::Interval, Self::Frustum];

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Masked => "masked",
            Self::Interval => "interval",
            Self::Frustum => "frustum",
        }
    }

    /// The most rays of a packet.
    pub fn largest(self) -> usize {
        match self {
            Self::Masked => 8,
            Self::Interval | Self::Frustum => 256,
        }
    }

    /// The sizes of packets to compare: what fits a vector, a tile of 8 x 8 and one of 16 x 16.
    pub fn sizes(self) -> &'static [usize] {
        match self {
            Self::Masked => &[8],
            Self::Interval | Self::Frustum => &[8, 64, 256],
        }
    }
}
