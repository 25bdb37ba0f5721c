//! The steps of the founding lecture (S6), for every strategy and K.

use super::distribute::Distribution;
use super::parallel::join;
use super::plane::SplitPlane;
use super::progress::Progress;
use super::reference::Reference;
use super::subtree::Subtree;
use super::{BuildError, BuildOptions};
use crate::geometry::Aabb;
use crate::primitives::Primitives;
use crate::tree::{KdTree, Node};

/// Chooses planes: all that the strategies differ in.
pub(super) trait ChoosePlane<const K: usize>: Sync {
    /// What is kept of a node besides its references.
    type Kept: Kept<K>;

    /// The plane that cuts the node, strictly inside its cell; `None` makes it a leaf.
    fn choose(&self, node: &NodeView<'_, K>, kept: &Self::Kept) -> Option<SplitPlane>;
}

/// Something about a node's references that is derived once and handed down.
pub(super) trait Kept<const K: usize>: Default + Send + Sync {
    /// That of the root.
    fn of_root(_references: &[Reference<K>]) -> Self {
        Self::default()
    }

    /// Fills those of the children, which may hold anything, when the references are distributed.
    fn hand_down(
        &self,
        _distribution: &Distribution,
        _references: [&[Reference<K>]; 2],
        _below: &mut Self,
        _above: &mut Self,
    ) {
    }
}

impl<const K: usize> Kept<K> for () {}

/// What a strategy sees of a node.
pub(super) struct NodeView<'a, const K: usize> {
    pub(super) cell: &'a Aabb<K>,
    pub(super) depth: usize,
    /// At least one.
    pub(super) references: &'a [Reference<K>],
}

/// One build: what over, and how.
pub(super) struct Build<'a, P, S> {
    pub(super) primitives: &'a P,
    pub(super) strategy: &'a S,
    pub(super) options: &'a BuildOptions,
    pub(super) progress: &'a Progress<'a>,
}

/// A node that is not yet cut or made a leaf.
struct OpenNode<const K: usize, E> {
    cell: Aabb<K>,
    depth: usize,
    /// How many references its leaves may have together.
    quota: u64,
    /// How many of the splits just above left every primitive in both children.
    futile_splits: u32,
    /// Its share of the progress.
    weight: u64,
    contents: Box<Contents<K, E>>,
}

/// A node's references and what is kept besides.
#[derive(Default)]
struct Contents<const K: usize, E> {
    references: Vec<Reference<K>>,
    kept: E,
}

/// What a thread uses again from node to node.
struct Workspace<const K: usize, E> {
    distribution: Distribution,
    spare: Vec<Box<Contents<K, E>>>,
    /// Progress that is not yet told.
    done: u64,
}

/// After so many splits in a row that leave every primitive in both children, a node is a leaf.
const FUTILE_SPLITS: u32 = 3;

/// Nodes with more references than this report progress, are built on two threads, and do not
/// leave their memory to others.
const LARGE: usize = 4096;

impl<P, S> Build<'_, P, S> {
    /// Builds the tree.
    pub(super) fn run<const K: usize>(&self) -> Result<KdTree<K>, BuildError>
    where
        P: Primitives<K>,
        S: ChoosePlane<K>,
    {
        let count = self.primitives.count();
        if count > Node::MAX_INDEX as usize {
            return Err(BuildError::TooManyPrimitives(count));
        }
        self.progress.add(0)?;

        // Step 1: put all primitives in the bounding box.
        let references = Reference::to_all(self.primitives)?;
        let cell = references.iter().fold(Aabb::EMPTY, |cell, r| cell.union(&r.bounds));
        self.progress.add(0)?;
        let root = OpenNode {
            cell,
            depth: 0,
            quota: BuildOptions::reference_quota(count),
            futile_splits: 0,
            weight: Progress::WHOLE,
            contents: Box::new(Contents { kept: S::Kept::of_root(&references), references }),
        };

        let mut tree = Subtree::default();
        let limit = self.options.depth_limit(count);
        self.build_apart(root, limit, &mut tree)?;
        Ok(KdTree { bounds: cell, nodes: tree.nodes, references: tree.references })
    }

    /// Builds a node with a workspace of its own.
    fn build_apart<const K: usize>(
        &self,
        node: OpenNode<K, S::Kept>,
        limit: usize,
        tree: &mut Subtree,
    ) -> Result<(), BuildError>
    where
        P: Primitives<K>,
        S: ChoosePlane<K>,
    {
        let mut workspace = Workspace::new();
        self.build_node(node, limit, &mut workspace, tree)?;
        self.progress.add(workspace.done)
    }

    /// Adds `node` and all below it to `tree`.
    fn build_node<const K: usize>(
        &self,
        node: OpenNode<K, S::Kept>,
        limit: usize,
        workspace: &mut Workspace<K, S::Kept>,
        tree: &mut Subtree,
    ) -> Result<(), BuildError>
    where
        P: Primitives<K>,
        S: ChoosePlane<K>,
    {
        let is_large = node.contents.references.len() > LARGE;
        if is_large || workspace.done > Progress::STEP {
            self.progress.add(std::mem::take(&mut workspace.done))?;
        } else {
            self.progress.check()?;
        }

        // Step 2: stop at few primitives or the depth limit.
        let stop = self.is_leaf(&node, limit);
        // Step 3: choose the plane, and 4: distribute the primitives.
        let plane = if stop { None } else { self.choose_plane(&node) };
        let children = plane.and_then(|plane| self.distribute(&node, plane, workspace));
        let (Some(plane), Some([below, above])) = (plane, children) else {
            tree.push_leaf(&node.contents.references);
            workspace.done += node.weight;
            workspace.give(node.contents);
            return Ok(());
        };
        workspace.give(node.contents);

        // Step 5: go on in both children from step 2.
        let index = tree.reserve_inner();
        if is_large {
            let mut upper = Subtree::default();
            let (lower_result, upper_result) = join(
                || self.build_apart(below, limit, tree),
                || self.build_apart(above, limit, &mut upper),
            );
            lower_result.and(upper_result)?;
            tree.close_lower(index, plane.axis, plane.position)?;
            tree.append(&upper)
        } else {
            self.build_node(below, limit, workspace, tree)?;
            tree.close_lower(index, plane.axis, plane.position)?;
            self.build_node(above, limit, workspace, tree)
        }
    }

    /// Whether step 2 ends the recursion here, or nothing has been gained for too long.
    fn is_leaf<const K: usize, E>(&self, node: &OpenNode<K, E>, limit: usize) -> bool {
        let count = node.contents.references.len();
        count == 0
            || count <= self.options.leaf_size
            || node.depth >= limit
            || node.futile_splits >= FUTILE_SPLITS
    }

    fn choose_plane<const K: usize>(&self, node: &OpenNode<K, S::Kept>) -> Option<SplitPlane>
    where
        S: ChoosePlane<K>,
    {
        let OpenNode { cell, depth, contents, .. } = node;
        let view = NodeView { cell, depth: *depth, references: &contents.references };
        self.strategy.choose(&view, &contents.kept)
    }

    /// The children, the lower first, unless they would hold more than the node's quota.
    fn distribute<const K: usize>(
        &self,
        node: &OpenNode<K, S::Kept>,
        plane: SplitPlane,
        workspace: &mut Workspace<K, S::Kept>,
    ) -> Option<[OpenNode<K, S::Kept>; 2]>
    where
        P: Primitives<K>,
        S: ChoosePlane<K>,
    {
        let (cell_below, cell_above) = node.cell.split(plane.axis, plane.position);
        let (mut below, mut above) = (workspace.take(), workspace.take());
        workspace.distribution.distribute(
            self.primitives,
            &node.contents.references,
            plane,
            [&cell_below, &cell_above],
            &mut below.references,
            &mut above.references,
        );
        let counts = [below.references.len(), above.references.len()];
        if (counts[0] + counts[1]) as u64 > node.quota {
            workspace.give(below);
            workspace.give(above);
            return None;
        }
        node.contents.kept.hand_down(
            &workspace.distribution,
            [&below.references, &above.references],
            &mut below.kept,
            &mut above.kept,
        );
        Some(node.children(counts, [(cell_below, below), (cell_above, above)]))
    }
}

impl<const K: usize, E> OpenNode<K, E> {
    fn children(
        &self,
        counts: [usize; 2],
        children: [(Aabb<K>, Box<Contents<K, E>>); 2],
    ) -> [Self; 2] {
        let count = self.contents.references.len();
        // Cutting off empty space neither is futile nor separates anything.
        let futile_splits = match counts {
            [below, above] if below == count && above == count => self.futile_splits + 1,
            [below, above] if below.min(above) == 0 => self.futile_splits,
            _ => 0,
        };
        let quotas = share(self.quota, counts);
        let weights = share(self.weight, counts);
        let child = |side: usize, cell, contents| {
            let (quota, weight) = (quotas[side], weights[side]);
            Self { cell, depth: self.depth + 1, quota, futile_splits, weight, contents }
        };
        let [(cell_below, below), (cell_above, above)] = children;
        [child(0, cell_below, below), child(1, cell_above, above)]
    }
}

/// `whole` in two parts, in proportion to `counts`. Where `whole` is at least their sum, each part
/// is at least its count.
fn share(whole: u64, counts: [usize; 2]) -> [u64; 2] {
    let [below, above] = counts.map(|count| count as u64);
    let part = if above == 0 { whole } else { whole * below / (below + above) };
    [part, whole - part]
}

impl<const K: usize, E: Kept<K>> Workspace<K, E> {
    fn new() -> Self {
        Self { distribution: Distribution::default(), spare: Vec::new(), done: 0 }
    }

    /// Contents without references; what is kept may be anything.
    fn take(&mut self) -> Box<Contents<K, E>> {
        self.spare.pop().unwrap_or_default()
    }

    /// Keeps the memory of contents for the next, unless it is much.
    fn give(&mut self, mut contents: Box<Contents<K, E>>) {
        if contents.references.capacity() <= LARGE {
            contents.references.clear();
            self.spare.push(contents);
        }
    }
}
