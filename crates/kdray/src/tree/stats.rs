//! Figures of a tree.

use super::{CostModel, KdTree, NodeKind};

/// What a tree is made of, and what it is expected to cost.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct TreeStats {
    /// How many primitives the tree was built over.
    pub primitives: usize,
    /// All nodes.
    pub nodes: usize,
    /// Nodes that are not cut.
    pub leaves: usize,
    /// Leaves without primitives.
    pub empty_leaves: usize,
    /// The largest number of splits above a leaf.
    pub max_depth: usize,
    /// How many leaves there are at each depth, from zero to `max_depth`.
    pub leaves_at_depth: Vec<usize>,
    /// The largest number of primitives in a leaf.
    pub largest_leaf: usize,
    /// Entries of all leaves' lists together.
    pub references: usize,
    /// References over primitives: how often a primitive is listed on average; 0 without any.
    pub references_per_primitive: f64,
    /// The surface area heuristic's expectation for a random ray that meets the root's box, under
    /// the given cost model.
    pub sah_cost: f64,
    /// Memory of nodes and references.
    pub bytes: usize,
}

impl<const K: usize> KdTree<K> {
    /// The figures of a tree over `primitives` primitives, its expected cost by `cost`.
    pub fn stats(&self, primitives: usize, cost: &CostModel) -> TreeStats {
        let mut stats = TreeStats {
            primitives,
            nodes: self.nodes.len(),
            references: self.references.len(),
            bytes: size_of_val(&*self.nodes) + size_of_val(&*self.references),
            ..TreeStats::default()
        };
        let surface = self.bounds.half_surface();
        for cell in self.cells() {
            // The chance that a line which meets the root's box meets this one. Lines miss a root
            // without surface; those aimed at it are taken to meet all of it.
            let has_surface = surface > 0.0 && !self.bounds.is_empty();
            let chance = if has_surface { cell.bounds.half_surface() / surface } else { 1.0 };
            match self.nodes[cell.node as usize].kind() {
                NodeKind::Inner { .. } => stats.sah_cost += chance * cost.traversal,
                NodeKind::Leaf { count, .. } => {
                    stats.sah_cost += chance * cost.leaf(count as usize);
                    stats.add_leaf(cell.depth as usize, count as usize);
                }
            }
        }
        if primitives > 0 {
            stats.references_per_primitive = stats.references as f64 / primitives as f64;
        }
        stats
    }
}

impl TreeStats {
    fn add_leaf(&mut self, depth: usize, count: usize) {
        self.leaves += 1;
        self.empty_leaves += usize::from(count == 0);
        self.largest_leaf = self.largest_leaf.max(count);
        self.max_depth = self.max_depth.max(depth);
        if self.leaves_at_depth.len() <= depth {
            self.leaves_at_depth.resize(depth + 1, 0);
        }
        self.leaves_at_depth[depth] += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Aabb;
    use crate::tree::Node;

    #[test]
    fn the_figures_of_a_small_tree() {
        let tree = KdTree {
            bounds: Aabb { min: [0.0, 0.0], max: [4.0, 2.0] },
            nodes: vec![
                Node::inner(0, 1.0, 2),
                Node::leaf(0, 0),
                Node::inner(1, 1.0, 4),
                Node::leaf(0, 1),
                Node::leaf(1, 2),
            ]
            .into(),
            references: vec![0, 0, 1].into(),
        };
        let cost = CostModel { traversal: 1.0, intersection: 3.0, ..CostModel::default() };
        let expected = TreeStats {
            primitives: 2,
            nodes: 5,
            leaves: 3,
            empty_leaves: 1,
            max_depth: 2,
            leaves_at_depth: vec![0, 1, 2],
            largest_leaf: 2,
            references: 3,
            references_per_primitive: 1.5,
            // Perimeters: root 6, its upper child 5, the leaves in that 4 each.
            sah_cost: 1.0 + 5.0 / 6.0 + 3.0 * (1.0 + 2.0) * (4.0 / 6.0),
            bytes: 5 * 8 + 3 * 4,
        };
        let found = tree.stats(2, &cost);
        assert!((found.sah_cost - expected.sah_cost).abs() < 1e-12);
        assert_eq!(TreeStats { sah_cost: expected.sah_cost, ..found }, expected);
    }

    #[test]
    fn an_empty_tree_costs_nothing() {
        let tree = KdTree::<3> {
            bounds: Aabb::EMPTY,
            nodes: vec![Node::leaf(0, 0)].into(),
            references: vec![].into(),
        };
        let stats = tree.stats(0, &CostModel::default());
        assert_eq!((stats.sah_cost, stats.references_per_primitive), (0.0, 0.0));
    }
}
