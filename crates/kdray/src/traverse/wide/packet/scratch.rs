//! Memory that packets work in.

use super::finish::Seen;
use super::prepare::Local;
use super::rays::{MOST_VECTORS, PacketRays};
use super::search::Found;
use super::stack::PacketStack;
use std::cell::RefCell;

/// What a packet needs besides the tree; each thread keeps its own, for to make it anew takes time.
pub(crate) struct Scratch {
    pub(super) local: Local,
    pub(super) rays: PacketRays,
    pub(super) stack: PacketStack,
    pub(super) found: Vec<Found>,
    pub(super) seen: Vec<Seen>,
}

impl Scratch {
    const EMPTY: Self = Self {
        local: [[[0.0; 8]; MOST_VECTORS]; 3],
        rays: PacketRays::EMPTY,
        stack: PacketStack::EMPTY,
        found: Vec::new(),
        seen: Vec::new(),
    };

    /// Lends this thread's.
    pub(crate) fn of_thread<R>(work: impl FnOnce(&mut Self) -> R) -> R {
        thread_local!(static SCRATCH: RefCell<Scratch> = const { RefCell::new(Scratch::EMPTY) });
        SCRATCH.with_borrow_mut(work)
    }
}
