//! The builder that is easy to believe.

use super::candidate::{AxisView, Candidate, SideCounts, better};
use crate::build::CostModel;
use crate::build::plane::SplitPlane;
use crate::build::reference::Reference;
use crate::build::steps::{ChoosePlane, NodeView};

/// Counts the primitives on both sides of each candidate by looking at all of them: O(N²).
pub(in crate::build) struct Naive {
    pub(in crate::build) cost: CostModel,
}

impl<const K: usize> ChoosePlane<K> for Naive {
    type Kept = ();
    type Scratch = ();

    fn choose(&self, node: &NodeView<'_, K>, (): &(), (): &mut ()) -> Option<SplitPlane> {
        let mut best = None;
        for axis in 0..K {
            let view = AxisView::new(node.cell, axis)?;
            for reference in node.references {
                for position in [reference.bounds.min[axis], reference.bounds.max[axis]] {
                    if view.is_inside(position) {
                        let counts = count_sides(node.references, axis, position);
                        best = better(best, Some(view.candidate(&self.cost, position, counts)));
                    }
                }
            }
        }
        best.filter(|best: &Candidate| self.cost.is_worth(best.cost, node.references.len()))
            .map(|best| best.plane)
    }
}

fn count_sides<const K: usize>(
    references: &[Reference<K>],
    axis: usize,
    position: f32,
) -> SideCounts {
    let mut counts = SideCounts { below: 0, planar: 0, above: 0 };
    for Reference { bounds, .. } in references {
        let (lo, hi) = (bounds.min[axis], bounds.max[axis]);
        counts.below += usize::from(lo < position);
        counts.planar += usize::from(lo == position && hi == position);
        counts.above += usize::from(hi > position);
    }
    counts
}
