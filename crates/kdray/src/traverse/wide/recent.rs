//! Which triangles were tested lately.

/// How many are remembered.
const COUNT: usize = 16;

/// The triangles that were tested last. A triangle may be in several leaves, most of the time neighbours on the ray's
/// way; what it was found to be is not found again.
#[derive(Clone, Copy)]
pub(super) struct Recent {
    ids: [u32; COUNT],
    next: usize,
}

impl Recent {
    /// None. No triangle has that id.
    pub(super) const NONE: Self = Self { ids: [u32::MAX; COUNT], next: 0 };

    /// Whether the triangle is none of them. It is one of them from then on.
    #[inline(always)]
    pub(super) fn add(&mut self, id: u32) -> bool {
        // All are compared, for that takes fewer steps than to stop at the right one.
        if self.ids.iter().fold(false, |is_found, &other| is_found | (other == id)) {
            return false;
        }
        self.ids[self.next % COUNT] = id;
        self.next += 1;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_ones_are_remembered() {
        let mut recent = Recent::NONE;
        assert!((0..20).all(|id| recent.add(id)));
        assert!((4..20).all(|id| !recent.add(id)));
        assert!(recent.add(0));
    }
}
