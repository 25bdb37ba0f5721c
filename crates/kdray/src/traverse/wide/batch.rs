//! Many rays through the wide tree, in turns.
//!
//! A single ray waits: for memory, and at each node for a long chain of instructions. Here the work
//! on one ray fills the gaps that others leave: a few rays are under way at once, and take turns at
//! nodes and at blocks.

use super::aim::Aim;
use super::climb::climb;
use super::line::NoAim;
use super::search::Search;
use super::slab::Slabs;
use super::stack::Stack;
use super::stacks::{Stacks, UNDER_WAY, with_stacks};
use super::start::Start;
use crate::geometry::Ray;
use crate::layout::{Link, WideTree};
use crate::primitives::TriangleMesh;
use crate::simd::{InstructionSet, Kernel, Lanes};
use std::marker::PhantomData;

/// A search along each of many rays.
struct Batch<'a, 's, Q: Search<'a>, R, A, F> {
    tree: &'a WideTree,
    mesh: &'a TriangleMesh<Q::Coordinate>,
    rays: R,
    stacks: &'s mut Stacks,
    scalar: A,
    found: F,
    search: PhantomData<Q>,
}

/// A ray under way.
struct Traveller<Q> {
    index: usize,
    aim: Aim,
    search: Q,
    /// Where it goes next: a node, the blocks of a leaf that are left, or the end.
    next: Link,
}

/// Travellers that wait for the same kind of step.
#[derive(Default)]
struct Queue {
    len: usize,
    slots: [u8; UNDER_WAY],
}

impl Queue {
    /// Adds a traveller if `wanted`. Without a branch, which could not be foretold.
    #[inline(always)]
    fn push_if(&mut self, wanted: bool, slot: u8) {
        self.slots[self.len % UNDER_WAY] = slot;
        self.len += usize::from(wanted);
    }

    /// Takes one.
    #[inline(always)]
    fn pop(&mut self) -> Option<u8> {
        self.len = self.len.checked_sub(1)?;
        Some(self.slots[self.len % UNDER_WAY])
    }
}

/// Searches along `rays`, and gives `found` the number of each ray with its answer, as they come; it may
/// take the answer, or leave it for its room. Rays that are out of the kernels' range are answered by `scalar`.
#[inline(always)]
pub(crate) fn search_along_each<'a, Q: Search<'a>>(
    (tree, mesh): (&'a WideTree, &'a TriangleMesh<Q::Coordinate>),
    rays: impl Iterator<Item: Start>,
    instructions: InstructionSet,
    scalar: impl Fn(&Ray<3>) -> Q::Answer,
    found: impl FnMut(usize, &mut Q::Answer),
) {
    with_stacks(|stacks| {
        let search = PhantomData::<Q>;
        instructions.run(Batch { tree, mesh, rays, stacks, scalar, found, search });
    });
}

impl<'a, Q: Search<'a>, R, A, F> Kernel for Batch<'a, '_, Q, R, A, F>
where
    R: Iterator<Item: Start>,
    A: Fn(&Ray<3>) -> Q::Answer,
    F: FnMut(usize, &mut Q::Answer),
{
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) {
        let Self { tree, mesh, rays, stacks, scalar, mut found, .. } = self;
        let mut rays = rays.enumerate().fuse();
        let mut travellers: [Traveller<Q>; UNDER_WAY] =
            std::array::from_fn(|_| Traveller::idle(mesh));
        let (mut nodes, mut leaves) = (Queue::default(), Queue::default());
        let mut idle = Queue { len: UNDER_WAY, slots: std::array::from_fn(|slot| slot as u8) };
        let mut room = Q::Answer::default();
        loop {
            while let Some(slot) = idle.pop() {
                let Some((index, ray)) = rays.next() else { break };
                let traveller = &mut travellers[usize::from(slot) % UNDER_WAY];
                let stack = &mut stacks[usize::from(slot) % UNDER_WAY];
                let started = traveller.start(simd, (tree, mesh), index, &ray, stack, &mut room);
                nodes.push_if(started.is_ok(), slot);
                idle.push_if(started.is_err(), slot);
                match started {
                    Ok(()) => {}
                    Err(NoAim::Missed) => found(index, &mut Q::Answer::default()),
                    Err(NoAim::OutOfRange) => found(index, &mut scalar(ray.ray())),
                }
            }
            if nodes.len + leaves.len == 0 {
                return;
            }
            // Queues are refilled from the front while they are read, which never catches up.
            for i in 0..std::mem::take(&mut nodes.len) {
                let slot = nodes.slots[i % UNDER_WAY];
                let traveller = &mut travellers[usize::from(slot) % UNDER_WAY];
                let stack = &mut stacks[usize::from(slot) % UNDER_WAY];
                traveller.pass_node(simd, tree, stack);
                let is_leaf = traveller.next.is_leaf();
                nodes.push_if(!is_leaf, slot);
                leaves.push_if(is_leaf, slot);
            }
            for i in 0..std::mem::take(&mut leaves.len) {
                let slot = leaves.slots[i % UNDER_WAY];
                let traveller = &mut travellers[usize::from(slot) % UNDER_WAY];
                let stack = &mut stacks[usize::from(slot) % UNDER_WAY];
                if traveller.next == Link::END || traveller.visit_block(simd, tree, stack) {
                    let mut answer = Q::Answer::default();
                    traveller.search.answer(&mut answer);
                    found(traveller.index, &mut answer);
                    room = answer;
                    idle.push_if(true, slot);
                    continue;
                }
                let is_leaf = traveller.next.is_leaf();
                nodes.push_if(!is_leaf, slot);
                leaves.push_if(is_leaf, slot);
            }
        }
    }
}

impl<'a, Q: Search<'a>> Traveller<Q> {
    fn idle(mesh: &'a TriangleMesh<Q::Coordinate>) -> Self {
        let ray = Ray { origin: [0.0; 3], direction: [0.0; 3], interval: crate::Interval::FORWARD };
        Self {
            index: 0,
            search: Q::new(&ray, mesh, &mut Q::Answer::default()),
            aim: Aim::NONE,
            next: Link::ROOT,
        }
    }

    #[inline(always)]
    fn start<S: Lanes, T: Start>(
        &mut self,
        simd: S,
        (tree, mesh): (&WideTree, &'a TriangleMesh<Q::Coordinate>),
        index: usize,
        start: &T,
        stack: &mut Stack,
        room: &mut Q::Answer,
    ) -> Result<(), NoAim> {
        self.aim.set::<S, Q::Coordinate>(simd, tree, start.ray())?;
        self.search = Q::new(start.ray(), mesh, room);
        stack.clear();
        self.index = index;
        self.next = Link::ROOT;
        if T::NEAR {
            let slabs = Slabs::new(simd, &self.aim);
            self.next = climb::<S, Q>(simd, tree, start.hint(), &self.aim, &slabs, stack);
        }
        Ok(())
    }

    /// Passes the next node.
    #[inline(always)]
    fn pass_node<S: Lanes>(&mut self, simd: S, tree: &WideTree, stack: &mut Stack) {
        let node = tree.node(self.next);
        let met = Slabs::new(simd, &self.aim).meet(simd, node);
        self.next = stack.push_and_pop::<S, Q>(&met, self.aim.t_far);
    }

    /// Visits the next block of a leaf; true if the search is over.
    #[inline(always)]
    fn visit_block<S: Lanes>(&mut self, simd: S, tree: &'a WideTree, stack: &mut Stack) -> bool {
        if self.search.visit(simd, tree.block(self.next, 0), &mut self.aim) {
            return true;
        }
        let rest = self.next.rest();
        self.next = if rest.block_count() > 0 { rest } else { stack.pop::<Q>(self.aim.t_far) };
        false
    }
}
