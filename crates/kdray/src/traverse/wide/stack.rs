//! What a ray has yet to visit.

use crate::layout::{Link, STACK_SIZE};
use crate::simd::{Lanes, Lists};
use fearless_simd::prelude::*;

/// Nodes and leaves that a ray has yet to visit, with where it enters their boxes.
pub(super) struct Stack {
    len: usize,
    t: [f32; STACK_SIZE],
    links: [u32; STACK_SIZE],
}

impl Stack {
    /// Nothing.
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self { len: 0, t: [0.0; STACK_SIZE], links: [0; STACK_SIZE] }
    }

    /// Adds the first `count` of eight, of which the last is visited next. There is always room
    /// for all eight: the layout sees to it.
    #[inline(always)]
    pub(super) fn push<S: Lanes>(&mut self, count: usize, lists: &Lists<S>) {
        let len = self.len;
        lists.t.store_slice(&mut self.t[len..len + 8]);
        lists.links.store_slice(&mut self.links[len..len + 8]);
        self.len = len + count;
    }

    /// Takes the next whose box the ray enters up to `t_far`.
    ///
    /// Those that wait below it cannot be dropped with one that begins behind `t_far`: boxes are
    /// wider than cells, so that a ray may meet the box of a cell that it passes by.
    #[inline(always)]
    pub(super) fn pop(&mut self, t_far: f32) -> Option<Link> {
        while self.len > 0 {
            self.len -= 1;
            if self.t[self.len] <= t_far {
                return Some(Link::from_bits(self.links[self.len]));
            }
        }
        None
    }
}
