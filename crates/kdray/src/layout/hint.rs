//! Where to begin a search.

/// A place in a scene's tree near which a ray starts, so that the search need not begin at the root.
///
/// It comes with a hit, and is good for rays that start there: see
/// [`Scene::any_hit_near`](crate::Scene::any_hit_near). It never changes an answer. One of another
/// place, or of another scene, only makes the search slower.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Hint(pub(super) u32);

impl Hint {
    /// No place: the search begins at the root.
    pub const NONE: Self = Self(u32::MAX);

    /// A hint that was kept as a number. Of any other number it is a hint as well, but not a good one.
    pub fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// As a number, to be kept. It means something only to the scene that it comes from.
    pub fn to_bits(self) -> u32 {
        self.0
    }
}

impl Default for Hint {
    fn default() -> Self {
        Self::NONE
    }
}
