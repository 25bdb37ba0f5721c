//! What a ray has yet to visit.

use super::search::Search;
use super::slab::Met;
use crate::layout::{Link, STACK_SIZE};
use crate::simd::{Lanes, Lists};
use fearless_simd::prelude::*;
use std::cell::RefCell;
use std::hint::select_unpredictable;

/// Nodes and leaves that a ray has yet to visit, with where it enters their boxes; the next is on
/// top. At the bottom lies [`Link::END`].
///
/// Aligned, so that stacks side by side lie 33 lines of a cache apart. Were it a power of two, the
/// lower parts of all would contend for the same few places.
#[repr(align(64))]
pub(super) struct Stack {
    t: [f32; STACK_SIZE],
    links: [u32; STACK_SIZE],
    len: usize,
}

impl Stack {
    /// Nothing but the end.
    pub(super) const EMPTY: Self = {
        let mut stack = Self { t: [0.0; STACK_SIZE], links: [0; STACK_SIZE], len: 1 };
        (stack.t[0], stack.links[0]) = (f32::NEG_INFINITY, Link::END.to_bits());
        stack
    };

    /// Lends this thread's stack: to fill a new one with zeros for each ray takes time.
    #[inline(always)]
    pub(super) fn of_thread<R>(work: impl FnOnce(&mut Self) -> R) -> R {
        thread_local!(static STACK: RefCell<Stack> = const { RefCell::new(Stack::EMPTY) });
        STACK.with_borrow_mut(work)
    }

    /// Forgets all.
    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.len = 1;
    }

    /// The next, with where the ray enters it.
    #[inline(always)]
    fn top(&self) -> (f32, Link) {
        let place = self.len.wrapping_sub(1) % STACK_SIZE;
        (self.t[place], Link::from_bits(self.links[place]))
    }

    /// Adds the children of a node. There is always room for all eight: the layout sees to it. Where
    /// they are entered is kept if the search shortens the ray.
    #[inline(always)]
    pub(super) fn push<'a, S: Lanes, Q: Search<'a>>(&mut self, met: &Met<S>) {
        self.push_lists(&met.lists, met.count, Q::SHORTENS);
    }

    /// Adds the first `count` of `lists`, with where they are entered only if that is wanted.
    #[inline(always)]
    pub(super) fn push_lists<S: Lanes>(&mut self, lists: &Lists<S>, count: usize, with_t: bool) {
        let room = self.len..self.len + 8;
        if with_t {
            self.t[room.clone()].copy_from_slice(lists.t.as_array());
        }
        self.links[room].copy_from_slice(lists.links.as_array());
        self.len += count;
    }

    /// Adds the children of a node but the nearest.
    #[inline(always)]
    pub(super) fn push_but_nearest<'a, S: Lanes, Q: Search<'a>>(&mut self, met: &Met<S>) {
        self.push::<S, Q>(met);
        self.len -= 1;
    }

    /// Adds the children of a node, and takes the next that begins before `t_far`. Without a branch
    /// on whether there are children, which could not be foretold.
    #[inline(always)]
    pub(super) fn push_and_pop<'a, S: Lanes, Q: Search<'a>>(
        &mut self,
        met: &Met<S>,
        t_far: f32,
    ) -> Link {
        let (t, waiting) = self.top();
        self.push_but_nearest::<S, Q>(met);
        let next = select_unpredictable(met.count > 0, met.nearest.to_bits(), waiting.to_bits());
        let t = select_unpredictable(met.count > 0, f32::NEG_INFINITY.to_bits(), t.to_bits());
        if !Q::SHORTENS || f32::from_bits(t) <= t_far {
            return Link::from_bits(next);
        }
        self.pop::<Q>(t_far)
    }

    /// Takes the next; if the search shortens the ray, the next whose box it enters up to `t_far`.
    #[inline(always)]
    pub(super) fn pop<'a, Q: Search<'a>>(&mut self, t_far: f32) -> Link {
        self.pop_up_to(t_far, Q::SHORTENS)
    }

    /// Takes the next; if `with_t`, the next that is entered up to `t_far`.
    ///
    /// Those that wait below it cannot be dropped with one that begins behind `t_far`: boxes are
    /// wider than cells, so that a ray may meet the box of a cell that it passes by.
    #[inline(always)]
    pub(super) fn pop_up_to(&mut self, t_far: f32, with_t: bool) -> Link {
        loop {
            let (t, link) = self.top();
            self.len = self.len.wrapping_sub(1);
            if !with_t || t <= t_far {
                return link;
            }
        }
    }
}
