//! The wide tree.

use super::arena::{Arena, Link, Room};
use super::collapse::Collapse;
use super::home::{Home, Site};
use super::homes::Homes;
use super::plan::{Plan, part_of_leaf};
use super::treelet::Treelet;
use super::{Hint, TriangleBlock, WideNode};
use crate::build::parallel::map_all;
use crate::build::progress::Progress;
use crate::build::{BuildError, BuildOptions, BuildProgress};
use crate::geometry::{Aabb, Coordinate, ROUNDING, TreeSpace};
use crate::primitives::TriangleMesh;
use crate::tree::{KdTree, NodeKind};
use arrayvec::ArrayVec;
use bytemuck::allocation::zeroed_vec;
use std::ops::ControlFlow;

/// Room on the kernels' stacks, of which one place is for the end. A tree that needs more is not
/// made wide.
pub(crate) const STACK_SIZE: usize = 256;

/// By how much boxes are made larger, and homes smaller, in units of u R ([`margin`]).
pub(super) const FULL_MARGIN: f32 = 12.0;

/// A kd-tree with eight children a node and copies of the triangles, eight to a block, in one piece
/// of memory: what single rays and batches are fastest on.
///
/// A child's box is the tight one of what lies in its cell, moved outward by what rounding in f32
/// may do to the slab test, for rays that start within [`reach`](Self::reach). Leaves hold the
/// same triangles as those of the canonical tree. Copies of f64 triangles are rounded to f32.
#[derive(Clone, Debug)]
pub struct WideTree {
    pub(super) arena: Arena,
    pub(super) homes: Homes,
    pub(super) reach: f32,
    pub(super) space: TreeSpace,
}

/// Of all that is to be done, how much it is to find out how to collapse the tree.
const COLLAPSE_WORK: u64 = Progress::WHOLE / 4;

/// The same for placing nodes and blocks. What is left is that for homes.
const PLACE_WORK: u64 = Progress::WHOLE / 2;

/// What is known of a subtree once it is placed.
struct Placed {
    link: Link,
    /// How many places on a traversal's stack it needs.
    stack: usize,
}

struct Placer<'a, T: 'static> {
    mesh: &'a TriangleMesh<T>,
    collapse: &'a Collapse<'a>,
    pad: f64,
    progress: &'a Progress<'a>,
    /// How many lines are placed in all.
    lines: usize,
}

impl WideTree {
    /// The wide form of `tree`, which is one over `mesh`; `boxes` are those around the parts of the
    /// triangles that are listed below each node. `None` if the mesh is larger than 2^32 or smaller
    /// than 2^-32, for the kernels' numbers are f32, or if the tree is larger than 16 GiB or
    /// needs more than the kernels' stacks. `progress` is told how far it is.
    ///
    /// # Errors
    /// [`BuildError::Memory`] if both trees would take more than the options allow: how many leaves
    /// list a triangle is only known now. [`BuildError::Cancelled`] if `progress` answers so.
    pub(crate) fn new<T: Coordinate>(
        tree: &KdTree<3>,
        boxes: &[Aabb<3>],
        mesh: &TriangleMesh<T>,
        options: &BuildOptions,
        progress: &(dyn Fn(BuildProgress) -> ControlFlow<()> + Sync),
    ) -> Result<Option<Self>, BuildError> {
        let progress = &Progress::new(progress);
        let wide = Self::make(tree, boxes, mesh, options, progress)?;
        progress.finish()?;
        Ok(wide)
    }

    fn make<T: Coordinate>(
        tree: &KdTree<3>,
        boxes: &[Aabb<3>],
        mesh: &TriangleMesh<T>,
        options: &BuildOptions,
        progress: &Progress<'_>,
    ) -> Result<Option<Self>, BuildError> {
        let Some(reach) = reach(tree.bounds()) else { return Ok(None) };
        let pad = margin(FULL_MARGIN, reach);
        let collapse = &Collapse::new(tree, boxes);
        progress.add(COLLAPSE_WORK)?;
        let plan = Plan::new(collapse);
        let held =
            size_of_val(tree.nodes()) + size_of_val(&tree.references[..]) + size_of_val(boxes);
        if !Arena::can_link(plan.size.lines) {
            return Ok(None);
        }
        let own = plan.size.bytes() + Homes::bytes_of(plan.size.slots(), plan.size.nodes);
        options.check_memory((held + own) as u64)?;
        let mut lines = zeroed_vec(plan.size.lines);
        let mut homes = zeroed_vec::<Home>(plan.size.nodes);
        let placer = Placer { mesh, collapse, pad, progress, lines: plan.size.lines };
        let mut room = Room::new(&mut lines, &mut homes);
        let root = placer.place_node(0, &Site::ROOT, &plan.children, &mut room)?;
        debug_assert!(room.is_empty(), "the plan is wrong");
        debug_assert_eq!(root.link, Link::ROOT);
        let arena = Arena::new(lines.into());
        let fits = stack_size(root.stack) <= STACK_SIZE;
        let space = *mesh.tree_space();
        Ok(fits.then(|| Self { homes: Homes::new(homes, &arena), arena, reach, space }))
    }

    /// How far from zero, on any axis, a ray may start so that the boxes' margins cover what
    /// rounding does: as far as the mesh, and four times its extent.
    pub fn reach(&self) -> f32 {
        self.reach
    }

    /// The coordinates that it is in.
    #[inline(always)]
    pub(crate) fn space(&self) -> &TreeSpace {
        &self.space
    }

    /// How much memory the tree takes, in bytes.
    pub fn bytes(&self) -> usize {
        self.arena.bytes() + self.homes.bytes()
    }

    #[inline(always)]
    pub(crate) fn node(&self, link: Link) -> &WideNode {
        self.arena.node(link)
    }

    #[inline(always)]
    pub(crate) fn block(&self, link: Link, index: usize) -> &TriangleBlock {
        self.arena.block(link, index)
    }

    /// The home of the node to begin at.
    #[inline(always)]
    pub(crate) fn home(&self, hint: Hint) -> &Home {
        self.homes.of_hint(hint)
    }

    /// The home of the node above.
    #[inline(always)]
    pub(crate) fn home_above(&self, home: &Home) -> &Home {
        self.homes.above(home)
    }

    /// The hint of a hit in one of the tree's blocks.
    pub(crate) fn hint(&self, block: &TriangleBlock) -> Hint {
        self.homes.hint(&self.arena, block)
    }
}

/// So many units of u R, with u half the distance from 1 to the next f32 and R the reach.
pub(super) fn margin(units: f32, reach: f32) -> f64 {
    f64::from(units * ROUNDING * reach)
}

/// How much room a traversal's stack needs if what waits beside the way down is so much at the most.
/// Twice, for those that begin below the root keep what is beside the way up on it.
pub(super) fn stack_size(beside: usize) -> usize {
    2 * beside + 1 + WideNode::WIDTH
}

/// See [`WideTree::reach`]; `None` if it is out of range.
pub(super) fn reach(bounds: &Aabb<3>) -> Option<f32> {
    const LARGEST: f64 = (1_u64 << 32) as f64;
    let corners = bounds.min.iter().chain(&bounds.max);
    let farthest = corners.fold(0.0_f32, |most, x| most.max(x.abs()));
    let extent = bounds.extent().into_iter().fold(0.0, f64::max);
    let reach = f64::from(farthest) + 4.0 * extent;
    (!bounds.is_empty() && reach < LARGEST && reach > 1.0 / LARGEST).then_some(reach as f32)
}

impl<T: Coordinate> Placer<'_, T> {
    /// Places a node of the binary tree as a wide one, then all below it: those of its children that
    /// are nodes at once if there are `plans` for them.
    fn place_node(
        &self,
        root: u32,
        site: &Site,
        plans: &[Plan],
        room: &mut Room<'_>,
    ) -> Result<Placed, BuildError> {
        let treelet = Treelet::new(self.collapse, root);
        let node_room = room.take_node(site, self.pad);
        let mut placed = ArrayVec::<_, { WideNode::WIDTH }>::new();
        let (mut tasks, mut plans) = (Vec::new(), plans.iter());
        for (place, &end) in treelet.ends.iter().enumerate() {
            let cell = treelet.cell(end, site.cell);
            let site = Site { cell, parent: node_room.home, place };
            let is_leaf =
                matches!(self.collapse.tree.nodes()[end as usize].kind(), NodeKind::Leaf { .. });
            placed.push(if is_leaf {
                let ids = self.collapse.tree.leaf_primitives(end);
                Some(self.place_leaf(ids, &site, &self.padded(end), room))
            } else if let Some(plan) = plans.next() {
                tasks.push((end, site, plan, room.take(plan.size)));
                None
            } else {
                Some(self.place_node(end, &site, &[], room)?)
            });
        }
        let place_apart = |(end, site, plan, mut room): (u32, Site, &Plan, Room<'_>)| {
            self.progress.check()?;
            let placed = self.place_node(end, &site, &plan.children, &mut room)?;
            debug_assert!(room.is_empty(), "the plan is wrong");
            if plan.children.is_empty() {
                self.progress.add(PLACE_WORK * plan.size.lines as u64 / self.lines as u64)?;
            }
            Ok(placed)
        };
        let apart = map_all(tasks, place_apart).into_iter();
        let apart = apart.collect::<Result<Vec<Placed>, BuildError>>()?;
        let mut apart = apart.into_iter();

        let mut node = WideNode::EMPTY;
        let mut stack = 0;
        for (place, (&end, placed)) in treelet.ends.iter().zip(placed).enumerate() {
            if let Some(child) = placed.or_else(|| apart.next()) {
                node.set_child(place, &self.padded(end), child.link);
                stack = stack.max(child.stack);
            }
        }
        for octant in 0..8 {
            node.set_order(octant, &treelet.far_to_near(octant));
        }
        let link = node_room.link;
        node_room.put(node);
        Ok(Placed { link, stack: stack + treelet.ends.len().saturating_sub(1) })
    }

    /// Places the triangles of a leaf; too many for one link below a node of their own.
    fn place_leaf(
        &self,
        ids: &[u32],
        site: &Site,
        bounds: &Aabb<3>,
        room: &mut Room<'_>,
    ) -> Placed {
        let Some(part) = part_of_leaf(ids.len()) else {
            let triangle = |&id: &u32| (id, self.mesh.rounded_corners(id));
            let blocks = ids.chunks(TriangleBlock::WIDTH);
            let blocks = blocks.map(|ids| TriangleBlock::new(ids.iter().map(triangle)));
            return Placed { link: room.put_leaf(blocks), stack: 0 };
        };
        let node_room = room.take_node(site, self.pad);
        let mut node = WideNode::EMPTY;
        let mut stack = 0;
        for (place, ids) in ids.chunks(part).enumerate() {
            // None, for not all that lies in the leaf's cell is below this part.
            let site = Site { cell: Aabb::EMPTY, parent: node_room.home, place };
            let child = self.place_leaf(ids, &site, bounds, room);
            node.set_child(place, bounds, child.link);
            stack = stack.max(child.stack);
        }
        let link = node_room.link;
        node_room.put(node);
        Placed { link, stack: stack + WideNode::WIDTH - 1 }
    }

    /// The box of a node, its faces moved outward by the pad at least.
    fn padded(&self, node: u32) -> Aabb<3> {
        let bounds = &self.collapse.boxes[node as usize];
        Aabb {
            min: bounds.min.map(|x| ((f64::from(x) - self.pad) as f32).next_down()),
            max: bounds.max.map(|x| ((f64::from(x) + self.pad) as f32).next_up()),
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::build::Preset;
    use rand::{RngExt, SeedableRng};

    pub(in crate::layout) fn wide(mesh: &TriangleMesh, options: &BuildOptions) -> WideTree {
        let go_on = |_| ControlFlow::Continue(());
        let (tree, boxes) = KdTree::build_with_boxes(mesh, options, &go_on).unwrap();
        WideTree::new(&tree, &boxes, mesh, options, &go_on).unwrap().unwrap()
    }

    pub(in crate::layout) fn soup(count: usize) -> TriangleMesh {
        let mut random = rand_pcg::Pcg64::seed_from_u64(1);
        let triangles = (0..count).map(|_| {
            let center = [0; 3].map(|_| random.random::<f32>());
            [0; 3].map(|_| center.map(|x| x + 0.02 * random.random::<f32>()))
        });
        TriangleMesh::from_soup(triangles).unwrap()
    }

    #[cfg(feature = "rayon")]
    #[test]
    fn it_is_the_same_for_any_number_of_threads() {
        let (mesh, options) = (soup(30_000), BuildOptions::preset(Preset::Fast));
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| wide(&mesh, &options))
        };
        let (one, three) = (on(1), on(3));
        assert!(one.arena == three.arena && one.homes == three.homes);
    }

    #[test]
    fn leaves_too_large_for_a_link_find_room() {
        let one_leaf = BuildOptions { leaf_size: usize::MAX, ..BuildOptions::preset(Preset::Best) };
        for count in [1, 56, 57, 449, 3000] {
            let tree = wide(&soup(count), &one_leaf);
            let mut ids = Vec::new();
            let mut waiting = vec![Link::ROOT];
            while let Some(link) = waiting.pop() {
                if link.is_leaf() {
                    let blocks = (0..link.block_count()).map(|index| tree.block(link, index));
                    ids.extend(blocks.flat_map(ids_of));
                } else {
                    waiting.extend(children_of(tree.node(link)));
                }
            }
            ids.sort_unstable();
            assert!(ids.iter().copied().eq(0..count as u32), "each triangle once: {ids:?}");
        }
    }

    /// The ids of a block's triangles.
    fn ids_of(block: &TriangleBlock) -> impl Iterator<Item = u32> {
        let lanes = (0..TriangleBlock::WIDTH).filter(|&lane| !block.corner(0, 0)[lane].is_nan());
        lanes.map(|lane| block.id(lane))
    }

    /// The links of a node's children.
    fn children_of(node: &WideNode) -> impl Iterator<Item = Link> {
        let [low, _] = node.planes(0);
        let places = (0..WideNode::WIDTH).filter(|&place| low[place] < f32::INFINITY);
        places.map(|place| Link::from_bits(node.links()[place]))
    }
}
