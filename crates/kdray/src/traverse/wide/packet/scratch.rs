//! Memory that packets work in.

use super::finish::Seen;
use super::prepare::Local;
use super::rays::{MOST_VECTORS, PacketRays};
use super::search::Found;
use crate::traverse::wide::stack::Stack;
use std::cell::RefCell;

/// What a packet needs besides the tree; each thread keeps its own, for to make it anew takes time.
pub(crate) struct Scratch {
    pub(super) local: Local,
    pub(super) rays: PacketRays,
    pub(super) stack: Stack,
    pub(super) found: Vec<Found>,
    pub(super) seen: Vec<Seen>,
}

impl Scratch {
    const EMPTY: Self = Self {
        local: [[[0.0; 8]; MOST_VECTORS]; 3],
        rays: PacketRays::EMPTY,
        stack: Stack::EMPTY,
        found: Vec::new(),
        seen: Vec::new(),
    };

    /// Lends this thread's.
    pub(crate) fn of_thread<R>(work: impl FnOnce(&mut Self) -> R) -> R {
        thread_local!(static SCRATCH: RefCell<Scratch> = const { RefCell::new(Scratch::EMPTY) });
        SCRATCH.with_borrow_mut(work)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_leaves_room_in_the_cache() {
        assert!(size_of::<Scratch>() <= 26 << 10, "{} bytes", size_of::<Scratch>());
    }
}
