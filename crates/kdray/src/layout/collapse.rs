//! How a binary tree is best collapsed into nodes of eight children.

use super::WideNode;
use super::treelet::filled;
use crate::geometry::Aabb;
use crate::tree::{KdTree, NodeKind};

const WIDTH: usize = WideNode::WIDTH;

/// For each node of a tree which of its two children gets how many places, so that a ray passes the
/// fewest wide nodes.
///
/// A ray that meets the root's box meets a node's box with a chance of the ratio of their surfaces.
/// The sum of the surfaces of all wide nodes is made the least by going through the tree from below:
/// what a subtree costs at best in one place, in two, up to eight, follows from what its children
/// cost (Ylitie, Karras and Laine, *Efficient Incoherent Ray Traversal on GPUs Through Compressed
/// Wide BVHs*, 2017, section 3.3; there for BVHs).
pub(super) struct Collapse<'a> {
    pub(super) tree: &'a KdTree<3>,
    /// Those of the tree's nodes.
    pub(super) boxes: &'a [Aabb<3>],
    shares: Vec<[u8; WIDTH]>,
}

/// What a subtree costs in one place, in two, and so on.
type Costs = [f32; WIDTH];

impl<'a> Collapse<'a> {
    pub(super) fn new(tree: &'a KdTree<3>, boxes: &'a [Aabb<3>]) -> Self {
        let mut costs = vec![Costs::default(); tree.nodes().len()];
        let mut shares = vec![[0; WIDTH]; tree.nodes().len()];
        // Children stand behind their parents.
        for node in (0..tree.nodes().len()).rev() {
            let NodeKind::Inner { above, .. } = tree.nodes()[node].kind() else { continue };
            let children = (filled(tree, boxes, node as u32 + 1), filled(tree, boxes, above));
            (costs[node], shares[node]) = match children {
                (Some(lower), Some(upper)) => {
                    let surface = boxes[node].half_surface() as f32;
                    best(surface, &costs[lower as usize], &costs[upper as usize])
                }
                _ => continue,
            };
        }
        Self { tree, boxes, shares }
    }

    /// How many of so many places the lower child of a node gets; none if the node is not to be cut
    /// open.
    pub(super) fn share(&self, node: u32, places: usize) -> usize {
        self.shares[node as usize][places - 1].into()
    }
}

/// The least costs of a node, and the shares of its lower child, from the costs of its children.
fn best(surface: f32, lower: &Costs, upper: &Costs) -> (Costs, [u8; WIDTH]) {
    let mut costs = [f32::INFINITY; WIDTH];
    let mut shares = [0; WIDTH];
    for places in 2..=WIDTH {
        for share in 1..places {
            let cost = lower[share - 1] + upper[places - share - 1];
            if cost < costs[places - 1] {
                (costs[places - 1], shares[places - 1]) = (cost, share as u8);
            }
        }
    }
    // Left as it is, it is a wide node of its own.
    let whole = surface + costs[WIDTH - 1];
    for (cost, share) in costs.iter_mut().zip(&mut shares).take(WIDTH - 1) {
        if whole <= *cost {
            (*cost, *share) = (whole, 0);
        }
    }
    (costs, shares)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_node_is_cut_open_where_that_saves_a_wide_node() {
        let leaf = [0.0; WIDTH];
        let (pair, shares) = best(2.0, &leaf, &leaf);
        // Alone it is a node of two leaves; in two places the leaves are children of what is above.
        assert_eq!((pair[0], pair[1], shares[0], shares[1]), (2.0, 0.0, 0, 1));
        // Two pairs in three places: the larger is cut open.
        let (large, _) = best(3.0, &leaf, &leaf);
        let (costs, shares) = best(5.0, &pair, &large);
        assert_eq!((costs[2], shares[2]), (2.0, 1));
        assert_eq!((costs[3], shares[3]), (0.0, 2));
        assert_eq!((costs[0], shares[0]), (5.0, 0));
    }
}
