//! The nodes and lists of a part of the tree, as they are built.

use super::BuildError;
use super::reference::Reference;
use crate::geometry::Aabb;
use crate::tree::{CostModel, KdTree, Node, NodeKind};

/// Nodes in depth-first order and the lists of their leaves, in pieces that were built apart.
///
/// Until [`finish`](Self::finish) an inner node says how far behind it its upper child stands, and a
/// leaf says nothing of where its list begins. So pieces that follow each other need not be copied.
pub(super) struct Subtree<const K: usize> {
    /// At least one; the last is open.
    pieces: Vec<Piece<K>>,
    keeps_boxes: bool,
    /// How many nodes there are.
    count: usize,
}

struct Piece<const K: usize> {
    nodes: Vec<Node>,
    references: Vec<u32>,
    /// The box around all that each node lists, if they are kept.
    boxes: Vec<Aabb<K>>,
}

/// Where an inner node stands whose children are being built, and where their lists begin.
#[derive(Clone, Copy)]
pub(super) struct Place {
    piece: usize,
    node: usize,
    reference: usize,
    /// How many nodes stand before it.
    before: usize,
}

impl<const K: usize> Subtree<K> {
    /// An empty one over `count` references.
    pub(super) fn new(keeps_boxes: bool, count: usize) -> Self {
        // Room for what most trees need. Lists that grow from nothing are copied ten times.
        let room = count.min(1 << 12);
        let boxes = Vec::with_capacity(if keeps_boxes { room / 2 } else { 0 });
        let (nodes, references) = (Vec::with_capacity(room / 2), Vec::with_capacity(room));
        Self { pieces: vec![Piece { nodes, references, boxes }], keeps_boxes, count: 0 }
    }

    fn open(&mut self) -> &mut Piece<K> {
        self.pieces.last_mut().expect("there is a piece at any time")
    }

    /// Adds a leaf; `tight` is the box around all that it lists.
    pub(super) fn push_leaf(&mut self, references: &[Reference<K>], tight: &Aabb<K>) {
        let ids = references.iter().map(|reference| reference.id);
        self.open().references.extend(ids);
        self.push_node(Node::leaf(0, references.len() as u32), tight);
    }

    fn push_node(&mut self, node: Node, tight: &Aabb<K>) {
        let keeps_boxes = self.keeps_boxes;
        let piece = self.open();
        piece.nodes.push(node);
        if keeps_boxes {
            piece.boxes.push(*tight);
        }
        self.count += 1;
    }

    /// Keeps the place of an inner node, until its children are there.
    pub(super) fn reserve_inner(&mut self) -> Place {
        let (piece, before) = (self.pieces.len() - 1, self.count);
        let Piece { nodes, references, .. } = self.open();
        let place = Place { piece, node: nodes.len(), reference: references.len(), before };
        self.push_node(Node::leaf(0, 0), &Aabb::EMPTY);
        place
    }

    /// Makes the node at `place` one whose upper child comes next.
    pub(super) fn close_lower(
        &mut self,
        place: Place,
        axis: usize,
        split: f32,
    ) -> Result<(), BuildError> {
        if self.count > Node::MAX_INDEX as usize {
            return Err(BuildError::TooManyNodes);
        }
        let distance = (self.count - place.before) as u32;
        self.pieces[place.piece].nodes[place.node] = Node::inner(axis, split, distance);
        Ok(())
    }

    /// Says what the box is around all that is listed below the node at `place`.
    pub(super) fn set_box(&mut self, place: Place, tight: &Aabb<K>) {
        if self.keeps_boxes {
            self.pieces[place.piece].boxes[place.node] = *tight;
        }
    }

    /// Makes a leaf of the node at `place` and all below it, which end this subtree. It lists what
    /// they listed, each primitive once, by rising id.
    pub(super) fn make_leaf(&mut self, place: Place, tight: &Aabb<K>) {
        let behind = self.pieces.split_off(place.piece + 1);
        self.count = place.before;
        let piece = self.open();
        piece.nodes.truncate(place.node);
        piece.boxes.truncate(place.node);
        behind.iter().for_each(|other| piece.references.extend_from_slice(&other.references));
        piece.references[place.reference..].sort_unstable();
        let mut end = place.reference;
        for next in place.reference..piece.references.len() {
            let id = piece.references[next];
            if end == place.reference || piece.references[end - 1] != id {
                piece.references[end] = id;
                end += 1;
            }
        }
        piece.references.truncate(end);
        self.push_node(Node::leaf(0, (end - place.reference) as u32), tight);
    }

    /// Adds a subtree that was built apart behind this one.
    pub(super) fn append(&mut self, other: Self) -> Result<(), BuildError> {
        self.count += other.count;
        if self.count > Node::MAX_INDEX as usize {
            return Err(BuildError::TooManyNodes);
        }
        self.pieces.extend(other.pieces);
        Ok(())
    }

    /// The tree in one piece, of which this is all, and the boxes of its nodes.
    pub(super) fn finish(self, bounds: Aabb<K>) -> (KdTree<K>, Vec<Aabb<K>>) {
        let sum = |length: fn(&Piece<K>) -> usize| self.pieces.iter().map(length).sum();
        let mut nodes = Vec::with_capacity(self.count);
        let mut references = Vec::with_capacity(sum(|piece| piece.references.len()));
        let mut boxes = Vec::with_capacity(sum(|piece| piece.boxes.len()));
        let mut first = 0;
        for piece in self.pieces {
            let start = nodes.len() as u32;
            nodes.extend((start..).zip(piece.nodes).map(|(index, node)| match node.kind() {
                NodeKind::Inner { axis, split, above } => Node::inner(axis, split, index + above),
                NodeKind::Leaf { count, .. } => {
                    first += count;
                    Node::leaf(first - count, count)
                }
            }));
            references.extend_from_slice(&piece.references);
            boxes.extend_from_slice(&piece.boxes);
        }
        (KdTree { bounds, nodes: nodes.into(), references: references.into() }, boxes)
    }
}

/// What a subtree is expected to cost the lines that meet the root, times the root's surface; and
/// the box around all that it lists, by whose surface that is reckoned.
#[derive(Clone, Copy)]
pub(super) struct Expected<const K: usize> {
    pub(super) cost: f64,
    pub(super) tight: Aabb<K>,
}

impl<const K: usize> Expected<K> {
    /// That of a leaf.
    pub(super) fn of_leaf(cost: &CostModel, references: &[Reference<K>]) -> Self {
        let tight = references.iter().fold(Aabb::EMPTY, |tight, r| tight.union(&r.bounds));
        Self { cost: surface(&tight) * cost.leaf(references.len()), tight }
    }

    /// That of a node with two children.
    pub(super) fn of_inner(cost: &CostModel, lower: &Self, upper: &Self) -> Self {
        let tight = lower.tight.union(&upper.tight);
        Self { cost: surface(&tight) * cost.traversal + lower.cost + upper.cost, tight }
    }

    /// That of the same as one leaf of `count` references.
    pub(super) fn if_leaf(&self, cost: &CostModel, count: usize) -> Self {
        Self { cost: surface(&self.tight) * cost.leaf(count), tight: self.tight }
    }
}

fn surface<const K: usize>(tight: &Aabb<K>) -> f64 {
    if tight.is_empty() { 0.0 } else { tight.half_surface() }
}
