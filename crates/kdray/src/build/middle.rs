//! Strategy A (S7): the middle of the box's longest side.

use super::plane::SplitPlane;
use super::steps::{ChoosePlane, NodeView};

/// The spatial median. Where the longest side is too thin to be cut, as far from zero, the longest that is not.
pub(super) struct Middle;

impl<const K: usize> ChoosePlane<K> for Middle {
    type Kept = ();
    type Scratch = ();

    fn choose(&self, node: &NodeView<'_, K>, (): &(), (): &mut ()) -> Option<SplitPlane> {
        SplitPlane::middle_of_longest(node.cell)
    }
}
