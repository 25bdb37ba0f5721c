//! The builder that is faster still: Popov et al., "Experiences with streaming construction of SAH
//! kd-trees", 2006, and Hunt et al., "Fast kd-tree construction with an adaptive error-bounded
//! heuristic", 2006.

use super::candidate::{AxisView, Candidate, better};
use super::event::{Event, Kind};
use super::sweep::sweep;
use crate::build::CostModel;
use crate::build::parallel::{fold, join};
use crate::build::plane::{PlanarSide, SplitPlane};
use crate::build::reference::Reference;
use crate::build::steps::{ChoosePlane, NodeView};
use crate::geometry::Aabb;

/// Counts bounds in equal bins on each axis of the cell, finds the border between bins of least
/// cost, and then the best of the bounds around that border, by a sweep over these. Small nodes
/// are swept as a whole; their bounds are sorted anew.
pub(in crate::build) struct Binned {
    pub(in crate::build) cost: CostModel,
    /// Nodes with no more references than this are swept.
    pub(in crate::build) sweep_below: usize,
}

/// Room to sort events in.
#[derive(Default)]
pub(in crate::build) struct Room(Vec<Event>);

/// Bins on each axis.
const BINS: usize = 32;

/// Nodes with fewer references than this have half as many bins.
const SMALL: usize = 256;

/// And nodes with fewer than this a quarter.
const TINY: usize = 64;

/// Room for the bins and the faces of the cell: a power of two.
const ROOM: usize = 64;

/// How far from a border, in bins, its candidates may lie.
const REACH: u32 = Scale::BIN / 2;

/// Nodes with more references than this are counted on several threads.
const LARGE: usize = 1 << 15;

impl<const K: usize> ChoosePlane<K> for Binned {
    type Kept = ();
    type Scratch = Room;

    fn choose(
        &self,
        node: &NodeView<'_, K>,
        (): &(),
        Room(events): &mut Room,
    ) -> Option<SplitPlane> {
        let count = node.references.len();
        let scales = if count > self.sweep_below {
            Scale::of_cell(node.cell, bins_for(count))
        } else {
            None
        };
        let best = match scales {
            Some(scales) => self.best_near_border(node, &scales, events),
            None => self.best_of_all(node, events),
        };
        best.filter(|best| self.cost.is_worth(best.cost, count)).map(|best| best.plane)
    }
}

impl Binned {
    /// The best of all candidates.
    fn best_of_all<const K: usize>(
        &self,
        node: &NodeView<'_, K>,
        events: &mut Vec<Event>,
    ) -> Option<Candidate> {
        let mut best = None;
        for axis in 0..K {
            let view = AxisView::new(node.cell, axis)?;
            let counts = collect_inside(node, axis, events);
            events.sort_unstable();
            best = better(best, sweep(&self.cost, &view, events, counts));
        }
        best
    }

    /// The best of the candidates around the best border between bins, or that border itself if
    /// there are none.
    fn best_near_border<const K: usize>(
        &self,
        node: &NodeView<'_, K>,
        scales: &[Scale; K],
        events: &mut Vec<Event>,
    ) -> Option<Candidate> {
        let count = |references: &[_]| Bins::of(references, scales);
        let bins = fold(node.references, LARGE, &count, &Bins::add);
        let (border, candidate) = self.best_border(node, scales, &bins)?;
        let axis = candidate.plane.axis;
        let around = Around { axis, scale: scales[axis], middle: border as u32 * Scale::BIN };
        events.clear();
        let counts = around.collect(node.references, events);
        events.sort_unstable();
        let view = AxisView::new(node.cell, axis)?;
        sweep(&self.cost, &view, events, counts).or(Some(candidate))
    }

    /// The best border between bins, and what it costs.
    fn best_border<const K: usize>(
        &self,
        node: &NodeView<'_, K>,
        scales: &[Scale; K],
        bins: &Bins<K>,
    ) -> Option<(usize, Candidate)> {
        let (mut least, mut best) = (f64::INFINITY, None);
        for (axis, scale) in scales.iter().enumerate() {
            let view = AxisView::new(node.cell, axis)?;
            let (mut below, mut above) = (0, node.references.len());
            for border in 1..bins_for(node.references.len()) {
                below += bins.starts[axis][border - 1] as usize;
                above -= bins.ends[axis][border] as usize;
                let position = scale.position(border);
                let cost = view.cost(&self.cost, position, [below, above]);
                if cost < least && view.is_inside(position) {
                    let candidate = view.at(position, PlanarSide::Above, cost);
                    (least, best) = (cost, Some((border, candidate)));
                }
            }
        }
        best
    }
}

/// How many bins a node of so many references has.
fn bins_for(count: usize) -> usize {
    match count {
        0..TINY => BINS / 4,
        TINY..SMALL => BINS / 2,
        _ => BINS,
    }
}

/// Makes `events` those strictly inside the cell, and returns how many primitives are below and
/// above before the first of them.
fn collect_inside<const K: usize>(
    node: &NodeView<'_, K>,
    axis: usize,
    events: &mut Vec<Event>,
) -> [usize; 2] {
    let (min, max) = (node.cell.min[axis], node.cell.max[axis]);
    // Each event is written, and stays if the length counts it.
    events.resize(2 * node.references.len() + 1, Event::default());
    let (mut length, mut below, mut above) = (0, 0, 0);
    for Reference { bounds, .. } in node.references {
        let (lo, hi) = (bounds.min[axis], bounds.max[axis]);
        let first = if lo == hi { Kind::Planar } else { Kind::Start };
        events[length] = Event::new(lo, first, 0);
        length += usize::from(min < lo && lo < max);
        events[length] = Event::new(hi, Kind::End, 0);
        length += usize::from(lo < hi && hi < max);
        below += usize::from(lo <= min);
        above += usize::from(hi > min);
    }
    events.truncate(length);
    [below, above]
}

/// Where positions on an axis lie among the bins, in fixed-point numbers: monotone, so that bounds
/// are counted consistently.
#[derive(Clone, Copy)]
struct Scale {
    min: f32,
    bins_per_length: f32,
    width: f64,
}

impl Scale {
    /// The width of a bin.
    const BIN: u32 = 128;

    /// A float so large that its last place is 1/128. The bits of the bin are zero.
    const SHIFT: f32 = 65536.0;

    /// Those of the axes; `None` if the cell is too small or too large for that.
    fn of_cell<const K: usize>(cell: &Aabb<K>, bins: usize) -> Option<[Self; K]> {
        let scales = std::array::from_fn(|axis| {
            let min = cell.min[axis];
            let extent = cell.max[axis] - min;
            let bins_per_length = if extent > 0.0 { bins as f32 / extent } else { 0.0 };
            Self { min, bins_per_length, width: f64::from(extent) / bins as f64 }
        });
        let is_good = |s: &Self| s.width.is_finite() && s.bins_per_length.is_finite();
        scales.iter().all(is_good).then_some(scales)
    }

    /// The place of `x`, a position in the cell.
    #[inline]
    fn place(&self, x: f32) -> u32 {
        self.shifted(x, Self::SHIFT).wrapping_sub(Self::SHIFT.to_bits())
    }

    /// The bin of `x`.
    #[inline]
    fn bin(&self, x: f32) -> usize {
        (self.shifted(x, Self::SHIFT) / Self::BIN) as usize & (ROOM - 1)
    }

    /// The first border that is not below `x`.
    #[inline]
    fn border(&self, x: f32) -> usize {
        const ROUND_UP: f32 = (Scale::BIN - 1) as f32 / Scale::BIN as f32;
        (self.shifted(x, Self::SHIFT + ROUND_UP) / Self::BIN) as usize & (ROOM - 1)
    }

    #[inline]
    fn shifted(&self, x: f32, shift: f32) -> u32 {
        ((x - self.min) * self.bins_per_length + shift).to_bits()
    }

    /// The position of the border below a bin.
    fn position(&self, border: usize) -> f32 {
        (f64::from(self.min) + border as f64 * self.width) as f32
    }
}

/// How many primitives begin and end where on each axis.
struct Bins<const K: usize> {
    /// By the bin that the lower bound lies in; at a border, in the bin above it.
    starts: [[u32; ROOM]; K],
    /// By the first border that the upper bound is not above; for a primitive in a border, the
    /// next.
    ends: [[u32; ROOM]; K],
}

impl<const K: usize> Bins<K> {
    fn of(references: &[Reference<K>], scales: &[Scale; K]) -> Self {
        let mut bins = Self { starts: [[0; _]; K], ends: [[0; _]; K] };
        for Reference { bounds, .. } in references {
            for (axis, scale) in scales.iter().enumerate() {
                let (start, end) = (scale.bin(bounds.min[axis]), scale.border(bounds.max[axis]));
                bins.starts[axis][start] += 1;
                bins.ends[axis][end.max(start + 1) % ROOM] += 1;
            }
        }
        bins
    }

    fn add(mut self, other: Self) -> Self {
        let pairs = self.starts.iter_mut().flatten().zip(other.starts.iter().flatten());
        pairs.for_each(|(count, more)| *count += more);
        let pairs = self.ends.iter_mut().flatten().zip(other.ends.iter().flatten());
        pairs.for_each(|(count, more)| *count += more);
        self
    }
}

/// The surroundings of a border.
struct Around {
    axis: usize,
    scale: Scale,
    middle: u32,
}

impl Around {
    /// Adds the events there, and returns how many primitives are below and above before the first
    /// of them.
    fn collect<const K: usize>(
        &self,
        references: &[Reference<K>],
        events: &mut Vec<Event>,
    ) -> [usize; 2] {
        if references.len() > LARGE {
            let (first, second) = references.split_at(references.len() / 2);
            let mut others = Vec::new();
            let (a, b) = join(|| self.collect(first, events), || self.collect(second, &mut others));
            events.append(&mut others);
            return [a[0] + b[0], a[1] + b[1]];
        }
        let (low, reach) = (self.middle - REACH, 2 * REACH);
        let mut counts = [0; 2];
        for Reference { bounds, .. } in references {
            let (lo, hi) = (bounds.min[self.axis], bounds.max[self.axis]);
            let (start, end) = (self.scale.place(lo), self.scale.place(hi));
            counts[0] += usize::from(start < low);
            counts[1] += usize::from(end >= low);
            if lo == hi {
                if start.wrapping_sub(low) <= reach {
                    events.push(Event::new(lo, Kind::Planar, 0));
                }
                continue;
            }
            if start.wrapping_sub(low) <= reach {
                events.push(Event::new(lo, Kind::Start, 0));
            }
            if end.wrapping_sub(low) <= reach {
                events.push(Event::new(hi, Kind::End, 0));
            }
        }
        counts
    }
}
