//! Strategy B (S8): as many primitives left as right.

use super::plane::SplitPlane;
use super::steps::{ChoosePlane, NodeView};

/// The object median: on the box's longest side, the median of the middles of the primitives'
/// bounds, clipped to the node's cell. Half of the middles lie below it, half above.
///
/// Where the median is no plane inside the cell, because most primitives lie in one of its faces,
/// the middle of the cell takes its place: of its longest side that can be cut.
pub(super) struct Median;

impl<const K: usize> ChoosePlane<K> for Median {
    type Kept = ();
    type Scratch = ();

    fn choose(&self, node: &NodeView<'_, K>, (): &(), (): &mut ()) -> Option<SplitPlane> {
        let axis = node.cell.longest_axis();
        let mut middles: Vec<f64> = node
            .references
            .iter()
            .map(|r| 0.5 * (f64::from(r.bounds.min[axis]) + f64::from(r.bounds.max[axis])))
            .collect();
        let half = middles.len() / 2;
        let (lower, &mut upper_median, _) = middles.select_nth_unstable_by(half, f64::total_cmp);
        // Of an even number, between the two in the middle.
        let lower_median = lower.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let is_odd = node.references.len() % 2 == 1;
        let median = if is_odd { upper_median } else { 0.5 * (lower_median + upper_median) };
        SplitPlane::inside(node.cell, axis, median as f32)
            .or_else(|| SplitPlane::middle_of_longest(node.cell))
    }
}
