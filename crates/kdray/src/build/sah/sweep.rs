//! The builder that is fast: Wald & Havran, "On building fast kd-trees for ray tracing, and on
//! doing that in O(N log N)", 2006, §4.3.

use super::candidate::{AxisView, Candidate, SideCounts, better};
use super::event::{Event, EventList, Kind};
use crate::build::CostModel;
use crate::build::distribute::Distribution;
use crate::build::parallel::join_if;
use crate::build::plane::{PlanarSide, SplitPlane};
use crate::build::reference::Reference;
use crate::build::steps::{ChoosePlane, Kept, NodeView};

/// Counts by passing a plane over the sorted bounds, which are sorted once at the root and spliced
/// from there down.
pub(in crate::build) struct Sweep {
    pub(in crate::build) cost: CostModel,
}

/// The events of a node on each axis.
pub(in crate::build) struct Events<const K: usize>([EventList; K]);

/// Nodes with more references than this are swept and spliced on several axes at a time.
const LARGE: usize = 1 << 15;

impl<const K: usize> ChoosePlane<K> for Sweep {
    type Kept = Events<K>;
    type Scratch = ();

    fn choose(
        &self,
        node: &NodeView<'_, K>,
        events: &Events<K>,
        (): &mut (),
    ) -> Option<SplitPlane> {
        let count = node.references.len();
        let best = self.best_from(0, node, events);
        best.filter(|best| self.cost.is_worth(best.cost, count)).map(|best| best.plane)
    }
}

impl Sweep {
    /// The best candidate on `axis` and those after it.
    fn best_from<const K: usize>(
        &self,
        axis: usize,
        node: &NodeView<'_, K>,
        events: &Events<K>,
    ) -> Option<Candidate> {
        let list = events.0.get(axis)?;
        let view = AxisView::new(node.cell, axis)?;
        let count = node.references.len();
        let (here, others) = join_if(
            count > LARGE,
            || sweep(&self.cost, &view, list.as_slice(), [0, count]),
            || self.best_from(axis + 1, node, events),
        );
        better(here, others)
    }
}

/// The best candidate on one axis among the positions of `events`. Before the first of them, there
/// are as many primitives below and above as `counts` says.
///
/// Of the events at a position, the last end or planar one, or the first start, sees the right
/// counts. The others are not told apart from them, which no branch prediction could: they see
/// higher counts, so they cost no less.
pub(super) fn sweep(
    cost: &CostModel,
    view: &AxisView,
    events: &[Event],
    counts: [usize; 2],
) -> Option<Candidate> {
    let (mut least, mut best) = (f64::INFINITY, None::<Candidate>);
    let [mut below, mut above] = counts;
    let mut rest = events.iter();
    while let Some(&event) = rest.next() {
        let position = event.position();
        if !view.is_below_max(position) {
            break;
        }
        let is_inside = view.is_inside(position);
        if event.kind() == Kind::Planar as usize {
            let others = rest.as_slice().iter().take_while(|other| other.is_planar_at(event));
            let planar = 1 + others.count();
            rest = rest.as_slice()[planar - 1..].iter();
            above -= planar;
            if is_inside {
                // An end here has counted the planar ones above without saying so.
                let candidate = view.candidate(cost, position, SideCounts { below, planar, above });
                let is_same = best.is_some_and(|best| best.plane.position == position);
                if candidate.cost < least || candidate.cost == least && is_same {
                    (least, best) = (candidate.cost, Some(candidate));
                }
            }
            below += planar;
            continue;
        }
        above -= usize::from(event.kind() == Kind::End as usize);
        // Positions rise, so of equal costs the first is the better one.
        let found = view.cost(cost, position, [below, above]);
        if is_inside && found < least {
            (least, best) = (found, Some(view.at(position, PlanarSide::Below, found)));
        }
        below += usize::from(event.kind() == Kind::Start as usize);
    }
    best
}

impl<const K: usize> Default for Events<K> {
    fn default() -> Self {
        Self(std::array::from_fn(|_| EventList::default()))
    }
}

impl<const K: usize> Kept<K> for Events<K> {
    const FOLLOWS: bool = true;

    fn of_root(references: &[Reference<K>]) -> Self {
        Self(std::array::from_fn(|axis| EventList::of_all(references, axis)))
    }

    fn hand_down(
        &self,
        distribution: &Distribution<K>,
        references: [&[Reference<K>]; 2],
        below: &mut Self,
        above: &mut Self,
    ) {
        let children = (&mut below.0[..], &mut above.0[..]);
        splice_from(0, &self.0, distribution, references, children);
    }
}

/// Splices the lists of `axis` and those after it.
fn splice_from<const K: usize>(
    axis: usize,
    parent: &[EventList],
    distribution: &Distribution<K>,
    references: [&[Reference<K>]; 2],
    (below, above): (&mut [EventList], &mut [EventList]),
) {
    if let ([list, lists @ ..], [below, belows @ ..], [above, aboves @ ..]) = (parent, below, above)
    {
        join_if(
            references[0].len() + references[1].len() > LARGE,
            || list.splice(axis, distribution, references, below, above),
            || splice_from(axis + 1, lists, distribution, references, (belows, aboves)),
        );
    }
}
