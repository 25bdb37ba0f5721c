//! Warnings of which a file can cause many.

use std::collections::BTreeMap;

/// How many warnings of a kind are told one by one. Nobody reads more, and a small file could take
/// all memory with them.
const TOLD: u64 = 100;

/// How many warnings there were of each kind.
#[derive(Default)]
pub(super) struct Repeated {
    counts: BTreeMap<&'static str, u64>,
}

impl Repeated {
    /// Counts a warning of a kind; whether it is to be told.
    pub(super) fn count(&mut self, kind: &'static str) -> bool {
        let count = self.counts.entry(kind).or_default();
        *count += 1;
        *count <= TOLD
    }

    /// A sentence for each kind of which some were not told.
    pub(super) fn rest(&self) -> Vec<String> {
        let untold = self.counts.iter().filter(|(_, count)| **count > TOLD);
        untold.map(|(kind, count)| format!("{} more {kind}", count - TOLD)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_told_is_counted_by_its_kind() {
        let mut repeated = Repeated::default();
        let told = (0..250).filter(|_| repeated.count("lights left out")).count();
        assert!((0..TOLD).all(|_| repeated.count("cameras left out")));
        assert_eq!((told, repeated.rest()), (100, vec!["150 more lights left out".to_owned()]));
    }
}
