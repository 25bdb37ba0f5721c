//! What must be true of every tree.

use super::content::ContentCheck;
use super::{Cell, KdTree, MAX_DEPTH, NodeKind, TreeError};
use crate::geometry::Aabb;
use crate::primitives::Primitives;

impl<const K: usize> KdTree<K> {
    /// Checks every invariant of a tree over `primitives`, and names the first that is broken:
    ///
    /// - nodes stand in depth-first order, none is missing or left over, and none is deeper than
    ///   [`MAX_DEPTH`];
    /// - splits lie strictly inside their nodes' cells, so children partition their parents, and no
    ///   cell is flat that the root's box does not make flat;
    /// - the leaves' lists tile the references; their ids exist and rise;
    /// - every primitive lies in the root's box, and every point of it in the closed cell of some
    ///   leaf that lists it; no leaf lists a primitive that has no part in its closed cell.
    ///
    /// The last two are checked up to two units in the last place of a coordinate, and 2^-38 of the
    /// largest one, because clipped bounds are rounded. They do not rely on how trees are built:
    /// each primitive is clipped anew on its way down from the root. Time grows with the number of
    /// references; a tree that was made so that it would take longer is refused, too.
    ///
    /// # Errors
    /// See [`TreeError`].
    pub fn validate(&self, primitives: &impl Primitives<K>) -> Result<(), TreeError> {
        let leaves = self.check_nodes()?;
        self.check_lists(&leaves, primitives.count())?;
        self.check_bounds(primitives)?;
        let check = ContentCheck::new(self, primitives);
        first_error(leaves.len(), |leaf| check.touches_what_it_lists(&leaves[leaf]))?;
        first_error(primitives.count(), |id| check.is_listed_everywhere(id as u32))?;
        check.took_few_steps()
    }

    /// The leaves in order, if the nodes are a tree of cells within cells.
    fn check_nodes(&self) -> Result<Vec<Cell<K>>, TreeError> {
        let nodes = self.nodes.len();
        if nodes == 0 {
            return Err(TreeError::NoRoot);
        }
        // Half of the nodes, and one.
        let mut leaves = Vec::with_capacity(nodes / 2 + 1);
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
            if !(bounds.min[axis] < split && split < bounds.max[axis]) {
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

    /// Whether the root's box is finite and holds all primitives.
    fn check_bounds(&self, primitives: &impl Primitives<K>) -> Result<(), TreeError> {
        for id in 0..primitives.count() as u32 {
            let bounds = primitives.bounds(id);
            if !bounds.is_empty() && self.bounds.union(&bounds) != self.bounds {
                return Err(TreeError::OutsideBounds { primitive: id });
            }
        }
        let finite = self.bounds.min.iter().chain(&self.bounds.max).all(|x| x.is_finite());
        if finite || self.bounds == Aabb::EMPTY { Ok(()) } else { Err(TreeError::BadBounds) }
    }
}

/// The first error of `check` for the numbers below `end`.
#[cfg(feature = "rayon")]
fn first_error(
    end: usize,
    check: impl Fn(usize) -> Result<(), TreeError> + Sync,
) -> Result<(), TreeError> {
    use rayon::prelude::*;
    // Small trees do not wait for the pool, as they are built.
    const FEW: usize = 1 << 12;
    if end < FEW {
        return (0..end).try_for_each(check);
    }
    (0..end).into_par_iter().map(&check).find_first(Result::is_err).unwrap_or(Ok(()))
}

/// The first error of `check` for the numbers below `end`.
#[cfg(not(feature = "rayon"))]
fn first_error(
    end: usize,
    check: impl Fn(usize) -> Result<(), TreeError>,
) -> Result<(), TreeError> {
    (0..end).try_for_each(check)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitives::{Segments, TriangleMesh};
    use crate::tree::Node;
    use crate::{BuildOptions, Strategy};
    use rand::{RngExt, SeedableRng};

    fn soup(snapped: bool) -> TriangleMesh {
        let mut random = rand_pcg::Pcg64::seed_from_u64(1);
        let snap = |x: f32| if snapped { (x * 4.0).round() / 4.0 } else { x };
        let triangles = (0..60).map(|_| {
            let center = [0; 3].map(|_| random.random::<f32>());
            [0; 3].map(|_| center.map(|x| snap(x + 0.6 * random.random::<f32>())))
        });
        TriangleMesh::from_soup(triangles).unwrap()
    }

    fn tree(mesh: &TriangleMesh, strategy: Strategy) -> KdTree {
        let tree = KdTree::build(mesh, &BuildOptions::for_strategy(strategy)).unwrap();
        assert_eq!(tree.validate(mesh), Ok(()));
        assert!(tree.nodes.len() > 20);
        tree
    }

    /// The error of a tree after `change`.
    fn broken(change: impl FnOnce(&mut KdTree)) -> TreeError {
        let mesh = soup(false);
        let mut tree = tree(&mesh, Strategy::Sah);
        change(&mut tree);
        tree.validate(&mesh).unwrap_err()
    }

    /// The tree with other lists in its leaves.
    fn with_lists(tree: &KdTree, list: impl Fn(u32) -> Vec<u32>) -> KdTree {
        let (mut nodes, mut references) = (tree.nodes.to_vec(), Vec::new());
        for node in 0..tree.nodes.len() as u32 {
            if let NodeKind::Leaf { .. } = tree.nodes[node as usize].kind() {
                let list = list(node);
                let first = references.len() as u32;
                nodes[node as usize] = Node::leaf(first, list.len() as u32);
                references.extend(list);
            }
        }
        KdTree { bounds: tree.bounds, nodes: nodes.into(), references: references.into() }
    }

    /// All pairs of a leaf and a primitive that it lists.
    fn listed(tree: &KdTree) -> Vec<(u32, u32)> {
        let nodes = 0..tree.nodes.len() as u32;
        nodes.flat_map(|n| tree.leaf_primitives(n).iter().map(move |&id| (n, id))).collect()
    }

    fn root(tree: &KdTree) -> (usize, f32, u32) {
        let NodeKind::Inner { axis, split, above } = tree.nodes[0].kind() else {
            panic!("the root is a leaf")
        };
        (axis, split, above)
    }

    #[test]
    fn nodes_out_of_place_are_named() {
        assert_eq!(broken(|tree| tree.nodes.edit(Vec::clear)), TreeError::NoRoot);
        let error = broken(|tree| {
            let (axis, split, _) = root(tree);
            let end = tree.nodes.len() as u32;
            tree.nodes.edit(|nodes| nodes[0] = Node::inner(axis, split, end));
        });
        assert!(matches!(error, TreeError::ChildOutOfRange { node: 0, .. }), "{error}");
        let error = broken(|tree| {
            let (axis, split, above) = root(tree);
            tree.nodes.edit(|nodes| nodes[0] = Node::inner(axis, split, above + 1));
        });
        assert!(matches!(error, TreeError::NotDepthFirst { .. }), "{error}");
        let error = broken(|tree| {
            let (axis, split, _) = root(tree);
            tree.nodes.edit(|nodes| nodes[0] = Node::inner(axis, split, 0));
        });
        assert!(matches!(error, TreeError::NotDepthFirst { node: 0, .. }), "a cycle: {error}");
        let error = broken(|tree| tree.nodes.edit(|nodes| nodes.push(Node::leaf(0, 0))));
        assert!(matches!(error, TreeError::UnreachedNodes { .. }), "{error}");
    }

    #[test]
    fn cells_that_do_not_partition_their_parents_are_named() {
        for outside in [100.0, -100.0, f32::NAN, f32::INFINITY] {
            let error = broken(|tree| {
                let (axis, _, above) = root(tree);
                tree.nodes.edit(|nodes| nodes[0] = Node::inner(axis, outside, above));
            });
            assert!(matches!(error, TreeError::SplitOutsideCell { node: 0, .. }), "{error}");
        }
        let error = broken(|tree| tree.bounds.max[0] = f32::INFINITY);
        assert_eq!(error, TreeError::BadBounds);
        let error = broken(|tree| *tree = KdTree { bounds: Aabb::EMPTY, ..tree.clone() });
        assert!(matches!(error, TreeError::SplitOutsideCell { node: 0, .. }), "{error}");
    }

    #[test]
    fn a_root_that_leaves_out_a_primitive_is_named() {
        let segments = Segments::new(vec![[[0.0, 0.0], [1.0, 1.0]], [[1.0, 0.0], [3.0, 0.0]]]);
        let bounds = Aabb { min: [0.0, 0.0], max: [2.0, 1.0] };
        let tree =
            KdTree { bounds, nodes: vec![Node::leaf(0, 2)].into(), references: vec![0, 1].into() };
        let expected = TreeError::OutsideBounds { primitive: 1 };
        assert_eq!(tree.validate(&segments.unwrap()), Err(expected));
    }

    #[test]
    fn an_axis_that_the_space_lacks_is_named() {
        let segments = Segments::new(vec![[[0.0, 0.0], [1.0, 1.0]]]).unwrap();
        let bounds = Aabb { min: [0.0; 2], max: [1.0; 2] };
        let nodes = vec![Node::inner(2, 0.5, 2), Node::leaf(0, 1), Node::leaf(1, 1)];
        let tree = KdTree { bounds, nodes: nodes.into(), references: vec![0, 0].into() };
        let expected = TreeError::BadAxis { node: 0, axis: 2, dimensions: 2 };
        assert_eq!(tree.validate(&segments), Err(expected));
    }

    #[test]
    fn a_tree_deeper_than_the_stack_is_named() {
        let chain = |splits: u32| {
            let split = |i: u32| 0.5_f32.powi(i as i32 + 1);
            let inner = (0..splits).map(|i| Node::inner(0, split(i), 2 * splits - i));
            let nodes = inner.chain((0..=splits).map(|_| Node::leaf(0, 0))).collect();
            KdTree {
                bounds: Aabb { min: [0.0; 3], max: [1.0; 3] },
                nodes,
                references: vec![].into(),
            }
        };
        let empty = TriangleMesh::<f32>::new(vec![], vec![]).unwrap();
        assert_eq!(chain(64).validate(&empty), Ok(()));
        let expected = TreeError::TooDeep { node: 65, depth: 65 };
        assert_eq!(chain(65).validate(&empty), Err(expected));
    }

    #[test]
    fn lists_that_do_not_tile_the_references_are_named() {
        let first_leaf = |tree: &KdTree| {
            let is_leaf = |n: &Node| matches!(n.kind(), NodeKind::Leaf { count, .. } if count > 0);
            tree.nodes.iter().position(is_leaf).unwrap()
        };
        let error = broken(|tree| {
            let leaf = first_leaf(tree);
            tree.nodes.edit(|nodes| nodes[leaf] = Node::leaf(1, 1));
        });
        assert!(matches!(error, TreeError::ListsDoNotTile { first: 1, expected: 0, .. }));
        let error = broken(|tree| {
            let leaf = first_leaf(tree);
            tree.nodes.edit(|nodes| nodes[leaf] = Node::leaf(0, 1 << 29));
        });
        assert!(matches!(error, TreeError::ListOutOfRange { .. }), "{error}");
        let error = broken(|tree| tree.references.edit(|all| all.push(0)));
        assert!(matches!(error, TreeError::UnlistedReferences { .. }), "{error}");
        let error = broken(|tree| tree.references.edit(|all| all[0] = 60));
        assert!(matches!(error, TreeError::NoSuchPrimitive { primitive: 60, count: 60, .. }));
        let error = broken(|tree| {
            *tree = with_lists(tree, |leaf| tree.leaf_primitives(leaf).repeat(2));
        });
        assert!(matches!(error, TreeError::NotAscending { .. }), "{error}");
    }

    #[test]
    fn every_single_reference_is_missed() {
        let mesh = soup(false);
        for strategy in [Strategy::Sah, Strategy::Middle] {
            let tree = tree(&mesh, strategy);
            for (node, primitive) in listed(&tree) {
                let keep = |leaf: u32, id: u32| (leaf, id) != (node, primitive);
                let lists = |leaf| {
                    tree.leaf_primitives(leaf)
                        .iter()
                        .copied()
                        .filter(|&id| keep(leaf, id))
                        .collect()
                };
                let found = with_lists(&tree, lists).validate(&mesh);
                assert_eq!(found, Err(TreeError::Missing { node, primitive }));
            }
        }
    }

    #[test]
    fn primitives_in_split_planes_are_missed_if_both_sides_lack_them() {
        let mesh = soup(true);
        let tree = tree(&mesh, Strategy::Sah);
        let count = listed(&tree).len();
        let caught = listed(&tree).into_iter().filter(|&(node, primitive)| {
            let keep = |leaf: u32, id: u32| (leaf, id) != (node, primitive);
            let lists = |leaf| {
                tree.leaf_primitives(leaf).iter().copied().filter(|&id| keep(leaf, id)).collect()
            };
            with_lists(&tree, lists).validate(&mesh).is_err()
        });
        // The others touch only the leaf's boundary, where a neighbour lists them too.
        let caught = caught.count();
        assert!(caught > count / 2, "{caught} of {count}");
        for primitive in 0..60 {
            let others = |leaf| {
                let list = tree.leaf_primitives(leaf).iter().copied();
                list.filter(|&id| id != primitive).collect()
            };
            let error = with_lists(&tree, others).validate(&mesh).unwrap_err();
            assert!(matches!(error, TreeError::Missing { primitive: id, .. } if id == primitive));
        }
    }

    #[test]
    fn a_reference_too_many_is_named() {
        let mesh = soup(false);
        let tree = tree(&mesh, Strategy::Sah);
        let everywhere = |_| (0..60).collect();
        let error = with_lists(&tree, everywhere).validate(&mesh).unwrap_err();
        assert!(matches!(error, TreeError::DoesNotTouch { .. }), "{error}");
    }

    #[test]
    fn a_plane_moved_aside_is_named() {
        for by in [-0.02, 0.02] {
            let error = broken(|tree| {
                let (axis, split, above) = root(tree);
                tree.nodes.edit(|nodes| nodes[0] = Node::inner(axis, split + by, above));
            });
            let expected = matches!(
                error,
                TreeError::Missing { .. }
                    | TreeError::DoesNotTouch { .. }
                    | TreeError::SplitOutsideCell { .. }
            );
            assert!(expected, "{error}");
        }
    }
}
