//! The leaves of a tree by their distance from a point.

use crate::tree::{KdTree, MAX_DEPTH, NodeKind};
use arrayvec::ArrayVec;

/// A bound for the relative error of a squared distance from a cell: six roundings, and room to
/// spare.
const ERROR: f64 = 8.0 * f64::EPSILON;

/// The leaves of a tree around a point, those of near cells before those of far ones, but for
/// cells on different sides of a plane (Arya and Mount 1993: the gaps to a cell differ from those
/// to its parent on one axis only).
///
/// It is conservative: no leaf is left out whose closed cell is within the limit, whatever rounds. A
/// gap of zero is exact, so that a limit of zero yields the leaves whose closed cells hold the
/// point, and those nearer than 2^-537.
#[derive(Clone, Debug)]
pub struct CellWalk<'a, const K: usize> {
    tree: &'a KdTree<K>,
    point: [f64; K],
    stack: ArrayVec<Waiting<K>, { MAX_DEPTH + 1 }>,
}

/// A node that is still to be visited.
#[derive(Clone, Copy, Debug)]
struct Waiting<const K: usize> {
    node: u32,
    /// How far the point is from the node's cell along each axis.
    gaps: [f64; K],
}

impl<'a, const K: usize> CellWalk<'a, K> {
    /// A walk around `point`, whose coordinates are finite.
    pub fn new(tree: &'a KdTree<K>, point: [f64; K]) -> Self {
        let mut stack = ArrayVec::new();
        if !tree.bounds.is_empty() {
            let gaps = std::array::from_fn(|k| {
                let (min, max) = (f64::from(tree.bounds.min[k]), f64::from(tree.bounds.max[k]));
                (min - point[k]).max(point[k] - max).max(0.0)
            });
            stack.push(Waiting { node: 0, gaps });
        }
        Self { tree, point, stack }
    }

    /// The primitives of the next leaf whose cell is within `limit` of the point.
    #[inline]
    pub fn next_leaf(&mut self, limit: f64) -> Option<&'a [u32]> {
        // Squares may vanish.
        let limit = limit * limit + if limit > 0.0 { f64::MIN_POSITIVE } else { 0.0 };
        let is_within = |gaps: &[f64; K]| (1.0 - ERROR) * squared(gaps) <= limit;
        let Waiting { mut node, gaps } = loop {
            let waiting = self.stack.pop()?;
            if is_within(&waiting.gaps) {
                break waiting;
            }
        };
        while let NodeKind::Inner { axis, split, above } = self.tree.nodes[node as usize].kind() {
            let gap = self.point[axis] - f64::from(split);
            let (near, far) = if gap < 0.0 { (node + 1, above) } else { (above, node + 1) };
            let mut far_gaps = gaps;
            far_gaps[axis] = gap.abs();
            if is_within(&far_gaps) {
                self.stack.push(Waiting { node: far, gaps: far_gaps });
            }
            node = near;
        }
        Some(self.tree.leaf_primitives(node))
    }
}

#[inline]
fn squared<const K: usize>(gaps: &[f64; K]) -> f64 {
    gaps.iter().map(|gap| gap * gap).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build::{BuildOptions, Preset};
    use crate::primitives::TriangleMesh;

    #[test]
    fn a_cell_is_within_a_limit_whose_square_vanishes() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0_f32]];
        let mesh = TriangleMesh::from_soup([corners]).unwrap();
        let tree = KdTree::build(&mesh, &BuildOptions::preset(Preset::Fast)).unwrap();
        for (gap, limit, is_within) in [(1.6e-162, 2.78e-162, true), (1e-100, 1e-101, false)] {
            let leaf = CellWalk::new(&tree, [-gap; 3]).next_leaf(limit);
            assert_eq!(leaf.is_some(), is_within, "{gap:e}");
        }
    }
}
