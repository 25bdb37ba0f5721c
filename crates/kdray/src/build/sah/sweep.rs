//! The builder that is fast: Wald & Havran, "On building fast kd-trees for ray tracing, and on
//! doing that in O(N log N)", 2006, §4.3.

use super::candidate::{AxisView, Candidate, SideCounts, better};
use super::event::{EventList, Kind};
use crate::build::CostModel;
use crate::build::distribute::Distribution;
use crate::build::plane::SplitPlane;
use crate::build::reference::Reference;
use crate::build::steps::{ChoosePlane, Kept, NodeView};

/// Counts by passing a plane over the sorted bounds, which are sorted once at the root and spliced
/// from there down.
pub(in crate::build) struct Sweep {
    pub(in crate::build) cost: CostModel,
}

/// The events of a node on each axis.
pub(in crate::build) struct Events<const K: usize>([EventList; K]);

impl<const K: usize> ChoosePlane<K> for Sweep {
    type Kept = Events<K>;

    fn choose(&self, node: &NodeView<'_, K>, events: &Events<K>) -> Option<SplitPlane> {
        let mut best = None;
        for (axis, list) in events.0.iter().enumerate() {
            let view = AxisView::new(node.cell, axis)?;
            best = better(best, self.sweep(&view, list, node.references.len()));
        }
        best.filter(|best| self.cost.is_worth(best.cost, node.references.len()))
            .map(|best| best.plane)
    }
}

impl Sweep {
    /// The best candidate on one axis.
    fn sweep(&self, view: &AxisView, events: &EventList, count: usize) -> Option<Candidate> {
        let mut best = None;
        let (mut below, mut above) = (0, count);
        let mut rest = events.as_slice();
        while let [first, ..] = rest {
            // All events at one position: what ends or is planar there is no longer above; what is
            // planar or starts there is below the next.
            let mut here = [0; 3];
            while let [event, tail @ ..] = rest
                && event.image() == first.image()
            {
                here[event.kind()] += 1;
                rest = tail;
            }
            let planar = here[Kind::Planar as usize];
            above -= planar + here[Kind::End as usize];
            let position = first.position();
            if view.is_inside(position) {
                let counts = SideCounts { below, planar, above };
                best = better(best, Some(view.candidate(&self.cost, position, counts)));
            }
            below += planar + here[Kind::Start as usize];
        }
        best
    }
}

impl<const K: usize> Default for Events<K> {
    fn default() -> Self {
        Self(std::array::from_fn(|_| EventList::default()))
    }
}

impl<const K: usize> Kept<K> for Events<K> {
    fn of_root(references: &[Reference<K>]) -> Self {
        Self(std::array::from_fn(|axis| EventList::of_all(references, axis)))
    }

    fn hand_down(
        &self,
        distribution: &Distribution,
        references: [&[Reference<K>]; 2],
        below: &mut Self,
        above: &mut Self,
    ) {
        let children = below.0.iter_mut().zip(&mut above.0);
        for (axis, (list, (below, above))) in self.0.iter().zip(children).enumerate() {
            list.splice(axis, distribution, references, below, above);
        }
    }
}
