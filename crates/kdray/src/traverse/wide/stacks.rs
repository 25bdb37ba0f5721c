//! The stacks of rays that are under way at once.

use super::stack::Stack;
use std::cell::RefCell;

/// Rays of a batch under way at once: their states should fit the first-level cache.
pub(super) const UNDER_WAY: usize = 16;

/// One for each ray under way.
pub(super) type Stacks = [Stack; UNDER_WAY];

/// Lends this thread's stacks: to make new ones takes as long as to answer a handful of rays.
#[inline(always)]
pub(super) fn with_stacks<R>(work: impl FnOnce(&mut Stacks) -> R) -> R {
    thread_local!(static STACKS: RefCell<Stacks> = const { RefCell::new([Stack::EMPTY; UNDER_WAY]) });
    STACKS.with(|stacks| match stacks.try_borrow_mut() {
        Ok(mut stacks) => work(&mut stacks),
        Err(_) => with_new_stacks(work),
    })
}

/// For a batch within a batch: one that is begun by the other's iterator, or where its answers go.
#[cold]
#[inline(never)]
fn with_new_stacks<R>(work: impl FnOnce(&mut Stacks) -> R) -> R {
    work(&mut [Stack::EMPTY; UNDER_WAY])
}
