//! Where primitives begin and end on an axis.

use crate::build::distribute::{Distribution, Fate};
use crate::build::parallel::sort;
use crate::build::reference::Reference;

/// A bound of a primitive on one axis, in 8 bytes that sort by position, then kind, then index: an
/// order-preserving image of the position, two bits of kind, and the index of the reference in its
/// node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Event(u64);

/// What happens at an event, in the order in which the sweep must see it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// The upper bound.
    End = 0,
    /// Both bounds at once.
    Planar = 1,
    /// The lower bound.
    Start = 2,
}

const INDEX_BITS: u32 = 30;
const INDEX_MASK: u64 = (1 << INDEX_BITS) - 1;

impl Event {
    fn new(position: f32, kind: Kind, index: u32) -> Self {
        let bits = position.to_bits();
        // Negative numbers in reverse, below the positive ones.
        let image = if bits >> 31 == 1 { !bits } else { bits | 1 << 31 };
        Self(u64::from(image) << 32 | (kind as u64) << INDEX_BITS | u64::from(index))
    }

    /// Equal for equal positions.
    #[inline]
    pub(super) fn image(self) -> u32 {
        (self.0 >> 32) as u32
    }

    #[inline]
    pub(super) fn position(self) -> f32 {
        let image = self.image();
        f32::from_bits(if image >> 31 == 1 { image & !(1 << 31) } else { !image })
    }

    /// The [`Kind`] as a number.
    #[inline]
    pub(super) fn kind(self) -> usize {
        (self.0 >> INDEX_BITS & 3) as usize
    }

    #[inline]
    fn index(self) -> usize {
        (self.0 & INDEX_MASK) as usize
    }

    #[inline]
    fn with_index(self, index: u32) -> Self {
        Self(self.0 & !INDEX_MASK | u64::from(index))
    }
}

/// The events of a node on one axis, in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct EventList(Vec<Event>);

impl EventList {
    /// The events of all `references`.
    pub(super) fn of_all<const K: usize>(references: &[Reference<K>], axis: usize) -> Self {
        let mut list = Self(Vec::with_capacity(2 * references.len()));
        for (index, reference) in references.iter().enumerate() {
            list.push(reference, index as u32, axis);
        }
        sort(&mut list.0);
        list
    }

    pub(super) fn as_slice(&self) -> &[Event] {
        &self.0
    }

    fn push<const K: usize>(&mut self, reference: &Reference<K>, index: u32, axis: usize) {
        let (lo, hi) = (reference.bounds.min[axis], reference.bounds.max[axis]);
        if lo == hi {
            self.0.push(Event::new(lo, Kind::Planar, index));
        } else {
            self.0.push(Event::new(lo, Kind::Start, index));
            self.0.push(Event::new(hi, Kind::End, index));
        }
    }

    /// Splices the list into those of the children: events of references that went to one child
    /// as they are stay in order; those of the clipped ones are made anew, sorted, and merged in.
    pub(super) fn splice<const K: usize>(
        &self,
        axis: usize,
        distribution: &Distribution,
        references: [&[Reference<K>]; 2],
        below: &mut Self,
        above: &mut Self,
    ) {
        below.0.clear();
        above.0.clear();
        for &event in &self.0 {
            match distribution.fates[event.index()] {
                Fate::Below(index) => below.0.push(event.with_index(index)),
                Fate::Above(index) => above.0.push(event.with_index(index)),
                Fate::Clipped => {}
            }
        }
        for (side, child) in [below, above].into_iter().enumerate() {
            let mut fresh = Self::default();
            for &index in &distribution.clipped[side] {
                fresh.push(&references[side][index as usize], index, axis);
            }
            fresh.0.sort_unstable();
            child.merge(&fresh.0);
        }
    }

    /// Merges in `fresh`, which is sorted, from the back.
    fn merge(&mut self, fresh: &[Event]) {
        let mut old = self.0.len();
        self.0.extend_from_slice(fresh);
        for (rest, &event) in fresh.iter().enumerate().rev() {
            while old > 0 && self.0[old - 1] > event {
                self.0[old + rest] = self.0[old - 1];
                old -= 1;
            }
            self.0[old + rest] = event;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn events_sort_by_position_kind_and_index() {
        let positions = [f32::MIN, -1.0, -1e-45, 0.0, 1e-45, 1.0, f32::MAX];
        let kinds = [Kind::End, Kind::Planar, Kind::Start];
        let all = |p| kinds.into_iter().flat_map(move |k| [0, 9].map(|i| (p, k, i)));
        let mut last = None;
        for (position, kind, index) in positions.into_iter().flat_map(all) {
            let event = Event::new(position, kind, index);
            let unpacked = (event.position(), event.kind(), event.index());
            assert_eq!(unpacked, (position, kind as usize, index as usize));
            assert!(last < Some(event));
            last = Some(event);
        }
    }

    #[test]
    fn merging_sorts() {
        let list = |x: &[f32]| x.iter().map(|&x| Event::new(x, Kind::Start, 0)).collect::<Vec<_>>();
        for (old, fresh) in [
            (&[1.0, 2.0, 5.0][..], &[0.0, 3.0, 4.0, 9.0][..]),
            (&[], &[1.0]),
            (&[1.0], &[]),
            (&[2.0], &[1.0, 3.0]),
        ] {
            let mut merged = EventList(list(old));
            merged.merge(&list(fresh));
            let mut expected = list(&[old, fresh].concat());
            expected.sort_unstable();
            assert_eq!(merged.0, expected);
        }
    }
}
