//! Many rays through the wide tree, in turns.
//!
//! A single ray waits for memory and for branches that were foretold wrongly. Here the work on one
//! ray fills the gaps that others leave: a few rays are under way at once, and take turns at nodes
//! and at leaves. That costs instructions, so it pays on large trees.

use super::aim::{Aim, NoAim};
use super::lanes::RayLanes;
use super::search::Search;
use super::slab::nearest_child;
use super::stack::Stack;
use crate::geometry::Ray;
use crate::layout::{Link, WideTree};
use crate::simd::{Kernel, Lanes};
use std::marker::PhantomData;

/// Rays under way at once: their states should fit the first-level cache.
const UNDER_WAY: usize = 16;

/// A search along each of many rays.
pub(crate) struct Batch<'a, Q, R, A, F> {
    tree: &'a WideTree,
    rays: R,
    scalar: A,
    found: F,
    search: PhantomData<Q>,
}

/// A ray under way.
struct Traveller<Q> {
    index: usize,
    aim: Aim,
    search: Q,
    stack: Stack,
    /// Where it goes next.
    next: Link,
}

/// Which travellers wait for the same kind of step.
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

    /// Takes all.
    #[inline(always)]
    fn take(&mut self) -> impl Iterator<Item = u8> + use<> {
        let Self { len, slots } = std::mem::take(self);
        slots.into_iter().take(len)
    }
}

/// What the travellers wait for.
struct Queues {
    nodes: Queue,
    leaves: Queue,
    idle: Queue,
}

impl Queues {
    #[inline(always)]
    fn push(&mut self, slot: u8, next: Option<Link>) {
        let is_leaf = next.is_some_and(Link::is_leaf);
        self.nodes.push_if(next.is_some() && !is_leaf, slot);
        self.leaves.push_if(is_leaf, slot);
    }
}

impl<'a, Q: Search, R, A, F> Batch<'a, Q, R, A, F>
where
    R: Iterator<Item = Ray<3>>,
    A: Fn(&Ray<3>) -> Q::Answer,
    F: FnMut(usize, Q::Answer),
{
    /// Searches along `rays`, and gives `found` the number of each ray with its answer, as they
    /// come. Rays that are out of the kernels' range are answered by `scalar`.
    #[inline(always)]
    pub(crate) fn new(tree: &'a WideTree, rays: R, scalar: A, found: F) -> Self {
        Self { tree, rays, scalar, found, search: PhantomData }
    }
}

impl<Q: Search, R, A, F> Kernel for Batch<'_, Q, R, A, F>
where
    R: Iterator<Item = Ray<3>>,
    A: Fn(&Ray<3>) -> Q::Answer,
    F: FnMut(usize, Q::Answer),
{
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) {
        let Self { tree, rays, scalar, mut found, .. } = self;
        let mut rays = rays.enumerate();
        let mut travellers: [Traveller<Q>; UNDER_WAY] = std::array::from_fn(|_| Traveller::idle());
        let all = Queue { len: UNDER_WAY, slots: std::array::from_fn(|slot| slot as u8) };
        let mut queues = Queues { nodes: Queue::default(), leaves: Queue::default(), idle: all };
        loop {
            while let Some(slot) = queues.idle.pop() {
                let Some((index, ray)) = rays.next() else { break };
                let traveller = &mut travellers[usize::from(slot) % UNDER_WAY];
                let started = traveller.start(tree, index, &ray);
                queues.nodes.push_if(started.is_ok(), slot);
                queues.idle.push_if(started.is_err(), slot);
                match started {
                    Ok(()) => {}
                    Err(NoAim::Missed) => found(index, Q::Answer::default()),
                    Err(NoAim::OutOfRange) => found(index, scalar(&ray)),
                }
            }
            if queues.nodes.len + queues.leaves.len == 0 {
                return;
            }
            for slot in queues.nodes.take() {
                let traveller = &mut travellers[usize::from(slot) % UNDER_WAY];
                let next = traveller.pass_node(simd, tree);
                queues.push(slot, next);
                if next.is_none() {
                    found(traveller.index, traveller.search.answer());
                    queues.idle.push_if(true, slot);
                }
            }
            for slot in queues.leaves.take() {
                let traveller = &mut travellers[usize::from(slot) % UNDER_WAY];
                let next = traveller.visit_leaf(simd, tree);
                queues.push(slot, next);
                if next.is_none() {
                    found(traveller.index, traveller.search.answer());
                    queues.idle.push_if(true, slot);
                }
            }
        }
    }
}

impl<Q: Search> Traveller<Q> {
    fn idle() -> Self {
        let ray = Ray { origin: [0.0; 3], direction: [0.0; 3], interval: crate::Interval::FORWARD };
        let (aim, stack) = (Aim::NONE, Stack::new());
        Self { index: 0, search: Q::new(&ray, &aim), aim, stack, next: Link::ROOT }
    }

    #[inline(always)]
    fn start(&mut self, tree: &WideTree, index: usize, ray: &Ray<3>) -> Result<(), NoAim> {
        self.aim.set(tree, ray)?;
        self.search = Q::new(ray, &self.aim);
        self.stack.clear();
        (self.index, self.next) = (index, Link::ROOT);
        Ok(())
    }

    /// Passes the next node, and says where to go then.
    #[inline(always)]
    fn pass_node<S: Lanes>(&mut self, simd: S, tree: &WideTree) -> Option<Link> {
        let lanes = RayLanes::new(simd, &self.aim, self.search.t_far());
        let node = tree.node(self.next);
        let next = nearest_child(simd, node, &self.aim, &lanes, &mut self.stack)
            .or_else(|| self.stack.pop(self.search.t_far()));
        self.next = next.unwrap_or(self.next);
        next
    }

    /// Visits the next leaf, and says where to go then.
    #[inline(always)]
    fn visit_leaf<S: Lanes>(&mut self, simd: S, tree: &WideTree) -> Option<Link> {
        let mut lanes = RayLanes::new(simd, &self.aim, self.search.t_far());
        for index in 0..self.next.block_count() {
            let block = tree.block(self.next, index);
            if self.search.visit(simd, block, &self.aim, &mut lanes) {
                return None;
            }
        }
        let next = self.stack.pop(self.search.t_far());
        self.next = next.unwrap_or(self.next);
        next
    }
}
