//! Whether leaves list what is in them.

use super::{Cell, KdTree, MAX_DEPTH, NodeKind, TreeError};
use crate::geometry::Aabb;
use crate::primitives::Primitives;
use arrayvec::ArrayVec;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// How many nodes may be passed in search of the primitives, for each node, reference and primitive.
///
/// Trees over ordinary scenes took 14 at most, whatever the strategy. But two sides of a plane may be cut so differently that there are
/// as many pieces of a primitive in the plane as the product of their cells; and so many cells may lie within
/// rounding of a primitive, or of a million, that each is sought in all of them. Such a tree breaks no other rule, but
/// no build is known to make one.
const STEPS: u64 = 1 << 8;

/// The checks that look at the primitives' shapes.
pub(super) struct ContentCheck<'a, P, const K: usize> {
    tree: &'a KdTree<K>,
    primitives: &'a P,
    /// The largest absolute coordinate.
    largest: f32,
    /// How many nodes were passed in search of primitives, and may be.
    steps: AtomicU64,
    most_steps: u64,
}

/// Part of a primitive that some leaves should list.
struct Part<const K: usize> {
    /// No less than the part, and no more than where it lies in the tree.
    bounds: Aabb<K>,
    /// All leaves that it lies in are in this subtree.
    top: Range<u32>,
    /// The nodes before this one were searched.
    from: u32,
    /// The leaf that does not list it, of a part that is looked for once more, with slack.
    missed_in: Option<u32>,
}

/// How a part is cut in two.
struct Cut {
    /// All leaves that it lies in and that were not searched are in this subtree.
    top: Range<u32>,
    /// The nodes before this one were searched.
    from: u32,
    axis: usize,
    split: f32,
}

/// What becomes of a part on its way down.
enum Fate {
    /// A leaf lists it.
    Listed,
    /// A plane cuts it.
    Cut(Cut),
    /// The leaves that it lies in, of which this is the last, do not list it.
    Missed(u32),
}

/// How far bounds at `x` that were clipped among coordinates up to `largest` may lie from the true
/// ones, with room to spare: they are computed in f64 and rounded to f32.
fn slack(x: f32, largest: f32) -> f32 {
    const IN_F64: f32 = 1.0 / (1_u64 << 38) as f32;
    2.0 * f32::EPSILON * x.abs() + IN_F64 * largest + f32::from_bits(2)
}

impl<'a, P: Primitives<K>, const K: usize> ContentCheck<'a, P, K> {
    pub(super) fn new(tree: &'a KdTree<K>, primitives: &'a P) -> Self {
        let largest = largest_coordinate(&tree.bounds);
        let size = tree.nodes.len() + tree.references.len() + primitives.count();
        let most_steps = STEPS.saturating_mul(size as u64);
        Self { tree, primitives, largest, steps: AtomicU64::new(0), most_steps }
    }

    pub(super) fn touches_what_it_lists(&self, leaf: &Cell<K>) -> Result<(), TreeError> {
        let Cell { node, bounds, .. } = *leaf;
        let grown = Aabb {
            min: bounds.min.map(|x| x - slack(x, self.largest)),
            max: bounds.max.map(|x| x + slack(x, self.largest)),
        };
        for &primitive in self.tree.leaf_primitives(node) {
            if self.primitives.clipped_bounds(primitive, &grown).is_none() {
                return Err(TreeError::DoesNotTouch { node, primitive });
            }
        }
        Ok(())
    }

    /// Whether each part of the primitive lies in the cell of a leaf that lists it.
    ///
    /// A part that is missed is looked for once more, with slack for the primitive's own coordinates:
    /// it may be there by a rounding error only. Then a part that sticks out of a cell by less than
    /// the slack lies in it, too.
    pub(super) fn is_listed_everywhere(&self, id: u32) -> Result<(), TreeError> {
        let Some(bounds) = self.primitives.clipped_bounds(id, &self.tree.bounds) else {
            return Ok(());
        };
        let largest = largest_coordinate(&self.primitives.bounds(id));
        let before = self.steps.load(Relaxed);
        let mut steps = before;
        let all = 0..self.tree.nodes.len() as u32;
        let mut parts = vec![Part { bounds, top: all.clone(), from: 0, missed_in: None }];
        while let Some(part) = parts.pop() {
            match self.fate(id, &part, largest, &mut steps)? {
                Fate::Listed => {}
                Fate::Cut(Cut { top, from, axis, split }) => {
                    let (below, above) = part.bounds.split(axis, split);
                    // The last one is looked for first.
                    for piece in [above, below] {
                        if let Some(shape) = self.primitives.clipped_bounds(id, &piece) {
                            let bounds = shape.intersection(&piece);
                            parts.push(Part { bounds, top: top.clone(), from, ..part });
                        }
                    }
                }
                Fate::Missed(leaf) => {
                    if let Some(node) = part.missed_in {
                        return Err(TreeError::Missing { node, primitive: id });
                    }
                    parts.push(Part { top: all.clone(), from: 0, missed_in: Some(leaf), ..part });
                }
            }
        }
        self.steps.fetch_add(steps - before, Relaxed);
        Ok(())
    }

    /// Looks for a part in the leaves in whose cells it lies, one after the other, until one lists it. A part in a
    /// plane lies in both children, either of which may list it. So if both sides cut it, it is cut as that side does
    /// which has fewer nodes: many cells on one side are not searched one by one for what a few on the other list.
    fn fate(
        &self,
        id: u32,
        part: &Part<K>,
        largest: f32,
        steps: &mut u64,
    ) -> Result<Fate, TreeError> {
        let &Part { bounds, ref top, from, missed_in } = part;
        // One waits on each level, and one more.
        let mut nodes = ArrayVec::<Range<u32>, { MAX_DEPTH + 1 }>::new();
        nodes.push(top.clone());
        let (mut leaf, mut cut) = (top.start, None::<(Cut, u32)>);
        while let Some(subtree) = nodes.pop() {
            *steps += 1;
            if *steps > self.most_steps {
                return Err(TreeError::TooManySteps(self.most_steps));
            }
            let node = subtree.start;
            let NodeKind::Inner { axis, split, above } = self.tree.nodes[node as usize].kind()
            else {
                if self.tree.leaf_primitives(node).binary_search(&id).is_ok() {
                    return Ok(Fate::Listed);
                }
                leaf = node;
                continue;
            };
            let slack = missed_in.map_or(0.0, |_| slack(split, largest));
            let lies_below = bounds.max[axis] - split <= slack;
            let lies_above = split - bounds.min[axis] <= slack;
            let straddles = bounds.min[axis] < split && split < bounds.max[axis];
            if straddles && !(lies_below && lies_above) {
                let size = subtree.end - node;
                match &mut cut {
                    None => {
                        let top = if nodes.is_empty() { subtree } else { top.clone() };
                        cut = Some((Cut { top, from: node, axis, split }, size));
                    }
                    Some((cut, smallest)) if size < *smallest => {
                        (cut.axis, cut.split, *smallest) = (axis, split, size);
                    }
                    Some(_) => {}
                }
                continue;
            }
            nodes.extend(lies_above.then_some(above..subtree.end));
            // The lower child and all below it stand before the upper one.
            nodes.extend((lies_below && from < above).then_some(node + 1..above));
        }
        Ok(cut.map_or(Fate::Missed(leaf), |(cut, _)| Fate::Cut(cut)))
    }

    /// Whether all the searches together took no more steps than they may.
    pub(super) fn took_few_steps(&self) -> Result<(), TreeError> {
        if self.steps.load(Relaxed) <= self.most_steps {
            Ok(())
        } else {
            Err(TreeError::TooManySteps(self.most_steps))
        }
    }
}

fn largest_coordinate<const K: usize>(aabb: &Aabb<K>) -> f32 {
    aabb.min.iter().chain(&aabb.max).fold(0.0, |largest, x| largest.max(x.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitives::TriangleMesh;
    use crate::tree::Node;

    /// A tree that grows from its first leaf to its last.
    struct Grown {
        nodes: Vec<Node>,
        references: Vec<u32>,
    }

    impl Grown {
        fn leaf(&mut self, list: &[u32]) {
            self.nodes.push(Node::leaf(self.references.len() as u32, list.len() as u32));
            self.references.extend(list);
        }

        fn cut(&mut self, axis: usize, split: f32, below: impl FnOnce(&mut Self)) {
            let place = self.nodes.len();
            self.nodes.push(Node::leaf(0, 0));
            below(self);
            self.nodes[place] = Node::inner(axis, split, self.nodes.len() as u32);
        }

        /// Cells side by side, one for each plane `at` less one, each with the list of its number.
        fn strips(
            &mut self,
            axis: usize,
            at: &[f32],
            first: usize,
            list: &impl Fn(usize) -> Vec<u32>,
        ) {
            if at.len() == 2 {
                return self.leaf(&list(first));
            }
            let half = at.len() / 2;
            self.cut(axis, at[half], |tree| tree.strips(axis, &at[..=half], first, list));
            self.strips(axis, &at[half..], first + half, list);
        }

        fn over(self, bounds: Aabb<3>) -> KdTree {
            KdTree { bounds, nodes: self.nodes.into(), references: self.references.into() }
        }
    }

    fn grown() -> Grown {
        Grown { nodes: Vec::new(), references: Vec::new() }
    }

    /// The same triangle so many times, in a plane.
    fn sheets(count: usize, x: f32) -> TriangleMesh {
        let sheet = [[x, 0.0, 0.0], [x, 1.0, 0.0], [x, 0.0, 1.0]];
        TriangleMesh::from_soup(vec![sheet; count]).unwrap()
    }

    const UNIT: Aabb<3> = Aabb { min: [0.0; 3], max: [1.0; 3] };

    #[test]
    fn flat_cells_are_refused() {
        let mesh = sheets(1, 0.5);
        for split in [0.0, 0.5, 1.0] {
            let mut tree = grown();
            tree.cut(0, 0.5, |tree| tree.leaf(&[0]));
            tree.cut(0, split, |tree| tree.leaf(&[]));
            tree.leaf(&[]);
            let found = tree.over(UNIT).validate(&mesh);
            let expected = TreeError::SplitOutsideCell { node: 2, axis: 0, split };
            assert_eq!(found, Err(expected));
        }
    }

    #[test]
    fn sides_of_a_plane_cut_crosswise_are_not_too_many_pieces() {
        let validate = |strips: usize| {
            let at: Vec<f32> = (0..=strips).map(|i| i as f32 / strips as f32).collect();
            let mut tree = grown();
            tree.cut(0, 0.5, |tree| tree.strips(1, &at, 0, &|_| vec![]));
            tree.strips(2, &at, 0, &|_| vec![0]);
            tree.over(UNIT).validate(&sheets(1, 0.5))
        };
        assert_eq!(validate(16), Ok(()));
        assert!(matches!(validate(1024), Err(TreeError::TooManySteps(_))));
    }

    #[test]
    fn sheets_on_many_cells_are_found_above_them() {
        // What stands below reaches up to the sheets, which are listed above: in one leaf, or in two.
        for leaves_above in [1, 2] {
            let strips = 1024;
            let at: Vec<f32> = (0..=strips).map(|i| i as f32 / strips as f32).collect();
            let all: Vec<u32> = (0..500).collect();
            let mut tree = grown();
            tree.cut(0, 0.5, |tree| tree.strips(1, &at, 0, &|_| vec![]));
            tree.strips(2, &[0.0, 0.5, 1.0][2 - leaves_above..], 0, &|_| all.clone());
            assert_eq!(tree.over(UNIT).validate(&sheets(500, 0.5)), Ok(()), "{leaves_above}");
        }
    }

    #[test]
    fn cells_within_rounding_are_not_searched_for_each_of_many() {
        let validate = |count: usize| {
            // The last one alone lists what lies in the first.
            let at: Vec<f32> = (0..=count).map(|i| i as f32 * 1e-30).collect();
            let all: Vec<u32> = (0..count as u32).collect();
            let list = |cell: usize| if cell + 1 == count { all.clone() } else { vec![] };
            let mut tree = grown();
            tree.strips(0, &at, 0, &list);
            tree.over(UNIT).validate(&sheets(count, 0.0))
        };
        assert_eq!(validate(64), Ok(()));
        assert!(matches!(validate(4096), Err(TreeError::TooManySteps(_))));
    }
}
