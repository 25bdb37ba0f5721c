//! Strategy C (S9): the axes X → Y → Z → X … in turn.

use super::plane::SplitPlane;
use super::steps::{ChoosePlane, NodeView};

/// The axis is the depth modulo K, the plane in the middle of the cell. An axis on which the cell
/// is too thin to be cut is passed over.
pub(super) struct RoundRobin;

impl<const K: usize> ChoosePlane<K> for RoundRobin {
    type Kept = ();
    type Scratch = ();

    fn choose(&self, node: &NodeView<'_, K>, (): &(), (): &mut ()) -> Option<SplitPlane> {
        (0..K).find_map(|turn| SplitPlane::middle(node.cell, (node.depth + turn) % K))
    }
}
