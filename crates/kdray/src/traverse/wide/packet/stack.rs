//! What a packet has yet to visit.

use crate::layout::{Link, STACK_SIZE};
use crate::simd::{Lanes, Lists};
use fearless_simd::prelude::*;

/// Nodes and leaves that a packet has yet to visit, with where it enters their boxes; the next is on top.
/// At the bottom lies [`Link::END`]. There is always room for all eight children of a node: the layout
/// sees to it.
pub(super) struct PacketStack {
    t: [f32; STACK_SIZE],
    links: [u32; STACK_SIZE],
    len: usize,
}

impl PacketStack {
    /// Nothing but the end.
    pub(super) const EMPTY: Self = {
        let mut stack = Self { t: [0.0; STACK_SIZE], links: [0; STACK_SIZE], len: 1 };
        (stack.t[0], stack.links[0]) = (f32::NEG_INFINITY, Link::END.to_bits());
        stack
    };

    /// Forgets all.
    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.len = 1;
    }

    /// Adds the first `count` of `lists`.
    #[inline(always)]
    pub(super) fn push<S: Lanes>(&mut self, lists: &Lists<S>, count: usize) {
        let room = self.len..self.len + 8;
        self.t[room.clone()].copy_from_slice(lists.t.as_array());
        self.links[room].copy_from_slice(lists.links.as_array());
        self.len += count;
    }

    /// Takes the next that begins before `z_far`.
    #[inline(always)]
    pub(super) fn pop(&mut self, z_far: f32) -> Link {
        loop {
            let place = self.len.wrapping_sub(1) % STACK_SIZE;
            self.len = self.len.wrapping_sub(1);
            if self.t[place] <= z_far {
                return Link::from_bits(self.links[place]);
            }
        }
    }
}
