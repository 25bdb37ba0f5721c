//! The steps of the founding lecture (S6), for every strategy and K.

use super::distribute::Distribution;
use super::parallel::join;
use super::plane::SplitPlane;
use super::progress::Progress;
use super::reference::{Reference, merge_parts};
use super::subtree::{Expected, Place, Subtree};
use super::{BuildError, BuildOptions};
use crate::geometry::Aabb;
use crate::primitives::Primitives;
use crate::tree::{KdTree, Node};

/// Chooses planes: all that the strategies differ in.
pub(super) trait ChoosePlane<const K: usize>: Sync {
    /// What is kept of a node besides its references.
    type Kept: Kept<K>;
    /// Memory that a thread uses again from node to node.
    type Scratch: Default + Send;

    /// The plane that cuts the node, strictly inside its cell; `None` makes it a leaf.
    fn choose(
        &self,
        node: &NodeView<'_, K>,
        kept: &Self::Kept,
        scratch: &mut Self::Scratch,
    ) -> Option<SplitPlane>;
}

/// Something about a node's references that is derived once and handed down.
pub(super) trait Kept<const K: usize>: Default + Send + Sync {
    /// Whether [`hand_down`](Self::hand_down) needs to know where each reference went.
    const FOLLOWS: bool;

    /// That of the root.
    fn of_root(_references: &[Reference<K>]) -> Self {
        Self::default()
    }

    /// Fills those of the children, which may hold anything, when the references are distributed.
    fn hand_down(
        &self,
        _distribution: &Distribution<K>,
        _references: [&[Reference<K>]; 2],
        _below: &mut Self,
        _above: &mut Self,
    ) {
    }
}

impl<const K: usize> Kept<K> for () {
    const FOLLOWS: bool = false;
}

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
    /// Whether the boxes around what is listed below each node are wanted, too.
    pub(super) keep_boxes: bool,
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
    kept: Box<E>,
}

/// What a thread works in.
struct Workspace<const K: usize, E, C> {
    /// A stack: the references of the open node are those on top.
    references: Vec<Reference<K>>,
    distribution: Distribution<K>,
    scratch: C,
    spare: Vec<Box<E>>,
    /// Progress that is not yet told.
    done: u64,
}

type WorkspaceOf<const K: usize, S> =
    Workspace<K, <S as ChoosePlane<K>>::Kept, <S as ChoosePlane<K>>::Scratch>;

/// After so many splits in a row that leave every primitive in both children, a node is a leaf.
const FUTILE_SPLITS: u32 = 3;

/// Nodes with more references than this report progress, and are built on two threads.
const LARGE: usize = 1024;

impl<P, S> Build<'_, P, S> {
    /// Builds the tree; with it come the boxes of its nodes, if they are wanted.
    pub(super) fn run<const K: usize>(&self) -> Result<(KdTree<K>, Vec<Aabb<K>>), BuildError>
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
            kept: Box::new(S::Kept::of_root(&references)),
        };

        let mut tree = Subtree::new(self.keep_boxes, references.len());
        let limit = self.options.depth_limit(count);
        self.build_apart(root, references, limit, &mut tree)?;
        Ok(tree.finish(cell))
    }

    /// Builds a node with a workspace of its own.
    fn build_apart<const K: usize>(
        &self,
        node: OpenNode<K, S::Kept>,
        references: Vec<Reference<K>>,
        limit: usize,
        tree: &mut Subtree<K>,
    ) -> Result<Expected<K>, BuildError>
    where
        P: Primitives<K>,
        S: ChoosePlane<K>,
    {
        let count = references.len();
        let mut workspace = Workspace::new(references);
        let expected = self.build_node(node, count, limit, &mut workspace, tree)?;
        self.progress.add(workspace.done)?;
        Ok(expected)
    }

    /// Adds `node`, whose references are the last `count` of the workspace, and all below it to
    /// `tree`. Takes the references away.
    fn build_node<const K: usize>(
        &self,
        node: OpenNode<K, S::Kept>,
        count: usize,
        limit: usize,
        workspace: &mut WorkspaceOf<K, S>,
        tree: &mut Subtree<K>,
    ) -> Result<Expected<K>, BuildError>
    where
        P: Primitives<K>,
        S: ChoosePlane<K>,
    {
        if count > LARGE || workspace.done > Progress::STEP {
            self.progress.add(std::mem::take(&mut workspace.done))?;
        } else {
            self.progress.check()?;
        }

        // Step 2: stop at few primitives or the depth limit.
        let first = workspace.references.len() - count;
        let stop = self.is_leaf(&node, count, limit);
        // Step 3: choose the plane, and 4: distribute the primitives.
        let plane = if stop { None } else { self.choose_plane(&node, first, workspace) };
        let children = plane.and_then(|plane| self.distribute(&node, first, plane, workspace));
        let (Some(plane), Some(children)) = (plane, children) else {
            let references = &workspace.references[first..];
            let expected = Expected::of_leaf(&self.options.cost, references);
            tree.push_leaf(references, &expected.tight);
            workspace.references.truncate(first);
            workspace.done += node.weight;
            workspace.spare.push(node.kept);
            return Ok(expected);
        };
        workspace.spare.push(node.kept);

        // Step 5: go on in both children from step 2.
        let place = tree.reserve_inner();
        let [lower, upper] = self.build_children(children, plane, limit, workspace, tree, place)?;

        // Pruning: what costs no more as a leaf is one.
        let cost = &self.options.cost;
        let cut = Expected::of_inner(cost, &lower, &upper);
        let uncut = cut.if_leaf(cost, count);
        if self.options.prune && uncut.cost <= cut.cost {
            tree.make_leaf(place, &uncut.tight);
            return Ok(uncut);
        }
        tree.set_box(place, &cut.tight);
        Ok(cut)
    }

    /// Builds both children of the node whose `place` in the tree is kept: on two threads if there
    /// is much to do.
    fn build_children<const K: usize>(
        &self,
        children: [(OpenNode<K, S::Kept>, usize); 2],
        plane: SplitPlane,
        limit: usize,
        workspace: &mut WorkspaceOf<K, S>,
        tree: &mut Subtree<K>,
        place: Place,
    ) -> Result<[Expected<K>; 2], BuildError>
    where
        P: Primitives<K>,
        S: ChoosePlane<K>,
    {
        let [(below, count_below), (above, count_above)] = children;
        if count_below.max(count_above) > LARGE {
            // A node this large has the workspace for itself, and leaves nothing in it: the children
            // may take long, and should hold no more than they must.
            let used = std::mem::replace(workspace, Workspace::new(Vec::new()));
            workspace.done = used.done;
            let (references_below, mut references_above) =
                (used.distribution.below, used.references);
            if references_above.capacity() > 2 * count_above {
                references_above.shrink_to_fit();
            }
            drop((used.distribution.fates, used.distribution.clipped, used.scratch, used.spare));
            let mut upper_tree = Subtree::new(self.keep_boxes, count_above);
            let (lower, upper) = join(
                || self.build_apart(below, references_below, limit, tree),
                || self.build_apart(above, references_above, limit, &mut upper_tree),
            );
            let expected = [lower?, upper?];
            tree.close_lower(place, plane.axis, plane.position)?;
            tree.append(upper_tree)?;
            return Ok(expected);
        }
        workspace.references.extend_from_slice(&workspace.distribution.below);
        let lower = self.build_node(below, count_below, limit, workspace, tree)?;
        tree.close_lower(place, plane.axis, plane.position)?;
        Ok([lower, self.build_node(above, count_above, limit, workspace, tree)?])
    }

    /// Whether step 2 ends the recursion here, or nothing has been gained for too long.
    fn is_leaf<const K: usize, E>(
        &self,
        node: &OpenNode<K, E>,
        count: usize,
        limit: usize,
    ) -> bool {
        count == 0
            || count <= self.options.leaf_size
            || node.depth >= limit
            || node.futile_splits >= FUTILE_SPLITS
    }

    fn choose_plane<const K: usize>(
        &self,
        node: &OpenNode<K, S::Kept>,
        first: usize,
        workspace: &mut WorkspaceOf<K, S>,
    ) -> Option<SplitPlane>
    where
        S: ChoosePlane<K>,
    {
        let references = &workspace.references[first..];
        let view = NodeView { cell: &node.cell, depth: node.depth, references };
        self.strategy.choose(&view, &node.kept, &mut workspace.scratch)
    }

    /// The children and how many references they have, the lower first, unless that would be more
    /// than the node's quota. Those of the upper one are left on the workspace's stack, those of
    /// the lower one beside it.
    fn distribute<const K: usize>(
        &self,
        node: &OpenNode<K, S::Kept>,
        first: usize,
        plane: SplitPlane,
        workspace: &mut WorkspaceOf<K, S>,
    ) -> Option<[(OpenNode<K, S::Kept>, usize); 2]>
    where
        P: Primitives<K>,
        S: ChoosePlane<K>,
    {
        let Workspace { references, distribution, spare, .. } = workspace;
        let count = references.len() - first;
        distribution.distribute(
            self.primitives,
            references,
            first,
            plane,
            &node.cell,
            S::Kept::FOLLOWS,
        );
        let counts = [distribution.below.len(), references.len() - first];
        if (counts[0] + counts[1]) as u64 > node.quota {
            references.append(&mut distribution.below);
            merge_parts(references, first);
            return None;
        }
        let (mut below, mut above) =
            (spare.pop().unwrap_or_default(), spare.pop().unwrap_or_default());
        let sides = [&distribution.below[..], &references[first..]];
        node.kept.hand_down(distribution, sides, &mut below, &mut above);
        let (cell_below, cell_above) = node.cell.split(plane.axis, plane.position);
        let [lower, upper] =
            node.children(count, counts, [(cell_below, below), (cell_above, above)]);
        Some([(lower, counts[0]), (upper, counts[1])])
    }
}

impl<const K: usize, E> OpenNode<K, E> {
    fn children(
        &self,
        count: usize,
        counts: [usize; 2],
        children: [(Aabb<K>, Box<E>); 2],
    ) -> [Self; 2] {
        // Cutting off empty space neither is futile nor separates anything.
        let futile_splits = match counts {
            [below, above] if below == count && above == count => self.futile_splits + 1,
            [below, above] if below.min(above) == 0 => self.futile_splits,
            _ => 0,
        };
        let quotas = share(self.quota, counts);
        let weights = share(self.weight, counts);
        let child = |side: usize, cell, kept| {
            let (quota, weight) = (quotas[side], weights[side]);
            Self { cell, depth: self.depth + 1, quota, futile_splits, weight, kept }
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

impl<const K: usize, E, C: Default> Workspace<K, E, C> {
    fn new(references: Vec<Reference<K>>) -> Self {
        let (distribution, scratch) = (Distribution::default(), C::default());
        Self { references, distribution, scratch, spare: Vec::new(), done: 0 }
    }
}
