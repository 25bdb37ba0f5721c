//! What must be true of every tree.

use super::{Cell, KdTree, MAX_DEPTH, NodeKind};
use crate::geometry::Aabb;
use crate::primitives::Primitives;
use thiserror::Error;

/// The first broken invariant that [`KdTree::validate`] found.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum TreeError {
    /// The tree has no node at all.
    #[error("the tree has no root")]
    NoRoot,
    /// The root's box has a NaN or infinite bound, or is empty although there are primitives.
    #[error("the root's box is not finite")]
    BadBounds,
    /// Part of a primitive lies outside the root's box.
    #[error("primitive {primitive} is not inside the root's box")]
    OutsideBounds {
        /// The primitive.
        primitive: u32,
    },
    /// A child's index is past the last node.
    #[error("node {node} has a child {child}, but there are only {nodes} nodes")]
    ChildOutOfRange {
        /// The parent.
        node: u32,
        /// The child that does not exist.
        child: u32,
        /// How many nodes there are.
        nodes: usize,
    },
    /// A node does not stand where depth-first order has it: behind the last one of the subtree
    /// before it.
    #[error("node {node} stands where depth-first order has node {expected}")]
    NotDepthFirst {
        /// The node that a parent names.
        node: u32,
        /// The one that it should name.
        expected: u32,
    },
    /// Nodes behind the last one that the root reaches.
    #[error("only the first {reached} of {nodes} nodes belong to the tree")]
    UnreachedNodes {
        /// How many nodes the root reaches.
        reached: usize,
        /// How many there are.
        nodes: usize,
    },
    /// A split perpendicular to an axis that the space does not have.
    #[error("node {node} is cut on axis {axis} of a space of {dimensions}")]
    BadAxis {
        /// The node.
        node: u32,
        /// Its axis.
        axis: usize,
        /// K.
        dimensions: usize,
    },
    /// A split that is not finite or lies outside its node's cell, so that the children do not
    /// partition it.
    #[error("node {node} is cut on axis {axis} at {split}, outside its cell")]
    SplitOutsideCell {
        /// The node.
        node: u32,
        /// The axis.
        axis: usize,
        /// Where the plane lies.
        split: f32,
    },
    /// A node deeper than traversal stacks allow.
    #[error("node {node} lies below {depth} splits; at most 64 are allowed")]
    TooDeep {
        /// The node.
        node: u32,
        /// How many splits lie above it.
        depth: u32,
    },
    /// A leaf's list is not the one behind that of the leaf before it.
    #[error("the list of leaf {node} starts at {first}, expected at {expected}")]
    ListsDoNotTile {
        /// The leaf.
        node: u32,
        /// Where its list starts.
        first: u32,
        /// Where the last leaf's ends.
        expected: u32,
    },
    /// A leaf's list goes on past the last reference.
    #[error("the list of leaf {node} goes on past the last of {references} references")]
    ListOutOfRange {
        /// The leaf.
        node: u32,
        /// How many references there are.
        references: usize,
    },
    /// References behind the last leaf's list.
    #[error("only the first {listed} of {references} references belong to a leaf")]
    UnlistedReferences {
        /// The end of the last leaf's list.
        listed: usize,
        /// How many references there are.
        references: usize,
    },
    /// A leaf lists a primitive that does not exist.
    #[error("leaf {node} lists primitive {primitive}, but there are only {count}")]
    NoSuchPrimitive {
        /// The leaf.
        node: u32,
        /// The id it lists.
        primitive: u32,
        /// How many primitives there are.
        count: usize,
    },
    /// A leaf's ids do not rise: one is listed twice or out of order.
    #[error("leaf {node} lists primitive {primitive} twice or out of order")]
    NotAscending {
        /// The leaf.
        node: u32,
        /// The id that is not above the one before it.
        primitive: u32,
    },
    /// A leaf lists a primitive that has no part in its cell.
    #[error("leaf {node} lists primitive {primitive}, which does not touch its cell")]
    DoesNotTouch {
        /// The leaf.
        node: u32,
        /// The primitive.
        primitive: u32,
    },
    /// Part of a primitive lies in a leaf's cell, but neither that leaf nor another one whose cell
    /// holds the part lists it.
    #[error("leaf {node} does not list primitive {primitive}, which lies partly in its cell")]
    Missing {
        /// The leaf.
        node: u32,
        /// The primitive.
        primitive: u32,
    },
}

impl<const K: usize> KdTree<K> {
    /// Checks every invariant of a tree over `primitives`, and names the first that is broken:
    ///
    /// - nodes stand in depth-first order, none is missing or left over, and none is deeper than
    ///   [`MAX_DEPTH`];
    /// - splits lie in their nodes' cells, so children partition their parents;
    /// - the leaves' lists tile the references; their ids exist and rise;
    /// - every primitive lies in the root's box, and every point of it in the closed cell of some
    ///   leaf that lists it; no leaf lists a primitive that has no part in its closed cell.
    ///
    /// The last two are checked up to four units in the last place of the largest coordinate,
    /// because clipped bounds are rounded. They do not rely on how trees are built: each primitive
    /// is clipped anew on its way down from the root. Time grows with the number of references.
    ///
    /// # Errors
    /// See [`TreeError`].
    pub fn validate(&self, primitives: &impl Primitives<K>) -> Result<(), TreeError> {
        let leaves = self.check_nodes()?;
        self.check_lists(&leaves, primitives.count())?;
        let slack = self.check_bounds(primitives)?;
        let check = ContentCheck { tree: self, primitives, slack };
        check.leaves_touch_what_they_list(&leaves)?;
        (0..primitives.count() as u32).try_for_each(|id| check.is_listed_everywhere(id))
    }

    /// The leaves in order, if the nodes are a tree of cells within cells.
    fn check_nodes(&self) -> Result<Vec<Cell<K>>, TreeError> {
        let nodes = self.nodes.len();
        if nodes == 0 {
            return Err(TreeError::NoRoot);
        }
        let mut leaves = Vec::new();
        let mut waiting = vec![Cell { node: 0, depth: 0, bounds: self.bounds }];
        let mut expected = 0;
        while let Some(Cell { node, depth, bounds }) = waiting.pop() {
            if node != expected {
                return Err(TreeError::NotDepthFirst { node, expected });
            }
            expected += 1;
            if depth as usize > MAX_DEPTH {
                return Err(TreeError::TooDeep { node, depth });
            }
            let NodeKind::Inner { axis, split, above } = self.nodes[node as usize].kind() else {
                leaves.push(Cell { node, depth, bounds });
                continue;
            };
            if let Some(child) = [node + 1, above].into_iter().find(|&c| c as usize >= nodes) {
                return Err(TreeError::ChildOutOfRange { node, child, nodes });
            }
            if axis >= K {
                return Err(TreeError::BadAxis { node, axis, dimensions: K });
            }
            if !(bounds.min[axis] <= split && split <= bounds.max[axis] && split.is_finite()) {
                return Err(TreeError::SplitOutsideCell { node, axis, split });
            }
            let (lower, upper) = bounds.split(axis, split);
            waiting.push(Cell { node: above, depth: depth + 1, bounds: upper });
            waiting.push(Cell { node: node + 1, depth: depth + 1, bounds: lower });
        }
        let reached = expected as usize;
        if reached == nodes {
            Ok(leaves)
        } else {
            Err(TreeError::UnreachedNodes { reached, nodes })
        }
    }

    /// Whether the leaves' lists tile the references with ids that exist and rise.
    fn check_lists(&self, leaves: &[Cell<K>], count: usize) -> Result<(), TreeError> {
        let references = self.references.len();
        let mut expected = 0;
        for &Cell { node, .. } in leaves {
            let NodeKind::Leaf { first, count: listed } = self.nodes[node as usize].kind() else {
                continue;
            };
            if first != expected {
                return Err(TreeError::ListsDoNotTile { node, first, expected });
            }
            if first as usize + listed as usize > references {
                return Err(TreeError::ListOutOfRange { node, references });
            }
            expected = first + listed;
            let mut last = None;
            for &primitive in self.leaf_primitives(node) {
                if primitive as usize >= count {
                    return Err(TreeError::NoSuchPrimitive { node, primitive, count });
                }
                if last >= Some(primitive) {
                    return Err(TreeError::NotAscending { node, primitive });
                }
                last = Some(primitive);
            }
        }
        let listed = expected as usize;
        if listed == references {
            Ok(())
        } else {
            Err(TreeError::UnlistedReferences { listed, references })
        }
    }

    /// Whether the root's box holds all primitives; the slack of the checks that clip.
    fn check_bounds(&self, primitives: &impl Primitives<K>) -> Result<f32, TreeError> {
        for id in 0..primitives.count() as u32 {
            let bounds = primitives.bounds(id);
            if !bounds.is_empty() && self.bounds.union(&bounds) != self.bounds {
                return Err(TreeError::OutsideBounds { primitive: id });
            }
        }
        if self.bounds == Aabb::EMPTY {
            return Ok(0.0);
        }
        let coordinates = self.bounds.min.iter().chain(&self.bounds.max);
        let largest = coordinates.fold(0.0_f32, |largest, x| largest.max(x.abs()));
        let finite = self.bounds.min.iter().chain(&self.bounds.max).all(|x| x.is_finite());
        if finite { Ok(largest * 4.0 * f32::EPSILON) } else { Err(TreeError::BadBounds) }
    }
}

/// The checks that look at the primitives' shapes.
struct ContentCheck<'a, P, const K: usize> {
    tree: &'a KdTree<K>,
    primitives: &'a P,
    slack: f32,
}

impl<P: Primitives<K>, const K: usize> ContentCheck<'_, P, K> {
    fn leaves_touch_what_they_list(&self, leaves: &[Cell<K>]) -> Result<(), TreeError> {
        for Cell { node, bounds, .. } in leaves {
            let grown = Aabb {
                min: bounds.min.map(|x| x - self.slack),
                max: bounds.max.map(|x| x + self.slack),
            };
            for &primitive in self.tree.leaf_primitives(*node) {
                if self.primitives.clipped_bounds(primitive, &grown).is_none() {
                    return Err(TreeError::DoesNotTouch { node: *node, primitive });
                }
            }
        }
        Ok(())
    }

    /// Whether each part of the primitive lies in the cell of a leaf that lists it.
    fn is_listed_everywhere(&self, id: u32) -> Result<(), TreeError> {
        match self.primitives.clipped_bounds(id, &self.tree.bounds) {
            Some(part) => self.is_part_listed(id, part, vec![0]),
            None => Ok(()),
        }
    }

    /// The same for its part in the box `part`, which lies in the cells of all `nodes` up to the
    /// slack. Goes down in one of them after the other; where a plane cuts the part, both pieces
    /// are looked at apart; a part in the plane lies in both children, either of which may list it.
    fn is_part_listed(&self, id: u32, part: Aabb<K>, mut nodes: Vec<u32>) -> Result<(), TreeError> {
        let mut leaf = 0;
        while let Some(node) = nodes.pop() {
            let NodeKind::Inner { axis, split, above } = self.tree.nodes[node as usize].kind()
            else {
                if self.tree.leaf_primitives(node).binary_search(&id).is_ok() {
                    return Ok(());
                }
                leaf = node;
                continue;
            };
            let fits_below = part.max[axis] <= split + self.slack;
            let fits_above = part.min[axis] >= split - self.slack;
            if !fits_below && !fits_above {
                nodes.push(node);
                let (below, above) = part.split(axis, split);
                for piece in [below, above] {
                    if let Some(shape) = self.primitives.clipped_bounds(id, &piece) {
                        self.is_part_listed(id, shape.intersection(&piece), nodes.clone())?;
                    }
                }
                return Ok(());
            }
            nodes.extend(fits_above.then_some(above));
            nodes.extend(fits_below.then_some(node + 1));
        }
        Err(TreeError::Missing { node: leaf, primitive: id })
    }
}
