//! What a ray has yet to visit.

use crate::layout::{Link, STACK_SIZE};
use crate::simd::{Lanes, Lists};
use arrayvec::ArrayVec;
use fearless_simd::prelude::*;

/// Nodes and leaves that a ray has yet to visit, with where it enters their boxes.
pub(super) struct Stack {
    t: ArrayVec<f32, STACK_SIZE>,
    links: ArrayVec<u32, STACK_SIZE>,
}

impl Stack {
    /// Nothing.
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self { t: ArrayVec::new(), links: ArrayVec::new() }
    }

    /// Forgets all.
    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.t.clear();
        self.links.clear();
    }

    /// Adds the first `count` of eight, of which the last is visited next. There is always room
    /// for all eight: the layout sees to it.
    #[inline(always)]
    pub(super) fn push<S: Lanes>(&mut self, count: usize, lists: &Lists<S>) {
        let len = self.t.len();
        let room = self.t.try_extend_from_slice(lists.t.as_array()).is_ok()
            && self.links.try_extend_from_slice(lists.links.as_array()).is_ok();
        debug_assert!(room, "the layout keeps stacks within {STACK_SIZE}");
        self.t.truncate(len + count);
        self.links.truncate(len + count);
    }

    /// Takes the next whose box the ray enters up to `t_far`.
    ///
    /// Those that wait below it cannot be dropped with one that begins behind `t_far`: boxes are
    /// wider than cells, so that a ray may meet the box of a cell that it passes by.
    #[inline(always)]
    pub(super) fn pop(&mut self, t_far: f32) -> Option<Link> {
        while let (Some(t), Some(link)) = (self.t.pop(), self.links.pop()) {
            if t <= t_far {
                return Some(Link::from_bits(link));
            }
        }
        None
    }
}
