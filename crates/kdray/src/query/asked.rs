//! Which instances a ray has met.

use arrayvec::ArrayVec;
use std::collections::HashSet;

/// How many are gone through one by one, which is faster than to hash.
const FEW: usize = 32;

/// The instances that a ray was put to, each of which may be listed by many leaves.
#[derive(Debug, Default)]
pub(super) struct Asked {
    first: ArrayVec<u32, FEW>,
    others: Option<HashSet<u32>>,
}

impl Asked {
    /// Whether this one may not have been asked yet; false is certain, and true may be wrong of all but the first few. Where
    /// it does no harm to ask again, that is faster than to know.
    pub(super) fn may_be_new(&mut self, id: u32) -> bool {
        let may_be_new = !self.first.contains(&id);
        if may_be_new && !self.first.is_full() {
            self.first.push(id);
        }
        may_be_new
    }

    /// Whether this one was not asked yet; now it is.
    pub(super) fn is_new(&mut self, id: u32) -> bool {
        !self.first.contains(&id)
            && (self.first.try_push(id).is_ok() || self.others.get_or_insert_default().insert(id))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_is_new_once() {
        let mut asked = Asked::default();
        for _ in 0..2 * FEW as u32 {
            let count = (0..3 * FEW as u32).filter(|&id| asked.is_new(id)).count();
            assert!(count == 3 * FEW || count == 0);
        }
        assert!((0..3 * FEW as u32).all(|id| !asked.is_new(id)));
        assert!(asked.is_new(u32::MAX));
    }

    #[test]
    fn the_first_few_are_known() {
        let mut asked = Asked::default();
        assert!((0..2 * FEW as u32).all(|id| asked.may_be_new(id)));
        assert!((0..FEW as u32).all(|id| !asked.may_be_new(id)));
    }
}
