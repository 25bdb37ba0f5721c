//! Where primitives begin and end on an axis.

use crate::build::distribute::Distribution;
use crate::build::parallel::sort;
use crate::build::reference::Reference;

/// A bound of a primitive on one axis, in 8 bytes that sort by position, then kind, then index: an
/// order-preserving image of the position, two bits of kind, and the index of the reference in its
/// node.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
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

const SIGN: u32 = 1 << 31;

/// All bits if the highest is set, or none.
#[inline]
fn sign_mask(bits: u32) -> u32 {
    (bits as i32 >> 31) as u32
}

const INDEX_BITS: u32 = 30;
const INDEX_MASK: u64 = (1 << INDEX_BITS) - 1;

impl Event {
    #[inline]
    pub(super) fn new(position: f32, kind: Kind, index: u32) -> Self {
        let bits = position.to_bits();
        // Negative numbers in reverse, below the positive ones.
        let image = bits ^ (sign_mask(bits) | SIGN);
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
        f32::from_bits(image ^ (sign_mask(!image) | SIGN))
    }

    /// The [`Kind`] as a number.
    #[inline]
    pub(super) fn kind(self) -> usize {
        (self.0 >> INDEX_BITS & 3) as usize
    }

    /// Whether it is planar and at the position of another planar one.
    #[inline]
    pub(super) fn is_planar_at(self, other: Self) -> bool {
        (self.0 ^ other.0) & !INDEX_MASK == 0
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

/// Longer lists are given no more memory than they need.
const LARGE: usize = 1 << 13;

/// The events of a node on one axis, in order.
#[derive(Clone, Debug, Default)]
pub(super) struct EventList {
    events: Vec<Event>,
    /// Room to sort new events in.
    fresh: Vec<Event>,
}

impl EventList {
    /// The events of all `references`.
    pub(super) fn of_all<const K: usize>(references: &[Reference<K>], axis: usize) -> Self {
        let mut events = Vec::with_capacity(2 * references.len());
        for (index, reference) in references.iter().enumerate() {
            push_events(&mut events, reference, index as u32, axis);
        }
        sort(&mut events);
        Self { events, fresh: Vec::new() }
    }

    pub(super) fn as_slice(&self) -> &[Event] {
        &self.events
    }

    /// Splices the list into those of the children: events of references that went to one child
    /// as they are stay in order; those of the clipped ones are made anew, sorted, and merged in.
    pub(super) fn splice<const K: usize>(
        &self,
        axis: usize,
        distribution: &Distribution<K>,
        references: [&[Reference<K>]; 2],
        below: &mut Self,
        above: &mut Self,
    ) {
        self.split_unchanged(distribution, &mut below.events, &mut above.events);
        for (side, child) in [below, above].into_iter().enumerate() {
            child.fresh.clear();
            for &index in &distribution.clipped[side] {
                push_events(&mut child.fresh, &references[side][index as usize], index, axis);
            }
            child.fresh.sort_unstable();
            merge(&mut child.events, &child.fresh);
        }
    }

    /// Each event is written to both lists, and stays in the one whose length counts it: which it
    /// is cannot be foretold, and a wrongly predicted branch would cost more.
    fn split_unchanged<const K: usize>(
        &self,
        distribution: &Distribution<K>,
        below: &mut Vec<Event>,
        above: &mut Vec<Event>,
    ) {
        let count = self.events.len();
        below.resize(count, Event(0));
        above.resize(count, Event(0));
        let (mut count_below, mut count_above) = (0, 0);
        for &event in &self.events {
            let fate = distribution.fates[event.index()];
            let event = event.with_index(fate.index());
            below[count_below] = event;
            above[count_above] = event;
            count_below += fate.is_below();
            count_above += fate.is_above();
        }
        for (events, count) in [(below, count_below), (above, count_above)] {
            events.truncate(count);
            if events.capacity() > LARGE {
                events.shrink_to_fit();
            }
        }
    }
}

fn push_events<const K: usize>(
    events: &mut Vec<Event>,
    reference: &Reference<K>,
    index: u32,
    axis: usize,
) {
    let (lo, hi) = (reference.bounds.min[axis], reference.bounds.max[axis]);
    if lo == hi {
        events.push(Event::new(lo, Kind::Planar, index));
    } else {
        events.push(Event::new(lo, Kind::Start, index));
        events.push(Event::new(hi, Kind::End, index));
    }
}

/// Merges `fresh` into `events`, both of which are sorted, from the back.
fn merge(events: &mut Vec<Event>, fresh: &[Event]) {
    let mut old = events.len();
    events.extend_from_slice(fresh);
    for (rest, &event) in fresh.iter().enumerate().rev() {
        while old > 0 && events[old - 1] > event {
            events[old + rest] = events[old - 1];
            old -= 1;
        }
        events[old + rest] = event;
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
            let mut merged = list(old);
            merge(&mut merged, &list(fresh));
            let mut expected = list(&[old, fresh].concat());
            expected.sort_unstable();
            assert_eq!(merged, expected);
        }
    }
}
