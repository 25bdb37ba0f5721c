//! The stacks of rays that are under way at once.

use super::stack::Stack;
use std::cell::RefCell;

/// Rays of a batch under way at once: their states should fit the first-level cache.
pub(super) const UNDER_WAY: usize = 16;

/// One for each ray under way.
pub(super) type Stacks = [Stack; UNDER_WAY];

/// Lends this thread's stacks: to make new ones takes as long as to answer a handful of rays. There
/// are new ones for a batch within a batch, which the other's iterator begins, or what takes its
/// answers. (`work` is called in one place, for it is a kernel, and each call would be a copy of it.)
#[inline(always)]
pub(super) fn with_stacks<R>(work: impl FnOnce(&mut Stacks) -> R) -> R {
    thread_local!(static STACKS: RefCell<Stacks> = const { RefCell::new([Stack::EMPTY; UNDER_WAY]) });
    STACKS.with(|stacks| {
        let mut of_thread = stacks.try_borrow_mut();
        let mut others;
        work(match &mut of_thread {
            Ok(stacks) => stacks,
            Err(_) => {
                others = new_stacks();
                &mut others
            }
        })
    })
}

#[cold]
#[inline(never)]
fn new_stacks() -> Box<Stacks> {
    Box::new([Stack::EMPTY; UNDER_WAY])
}
