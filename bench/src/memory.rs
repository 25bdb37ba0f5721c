//! How many bytes of the heap are in use, counted by the allocator of the whole program.

use cap::Cap;
use std::alloc::System;

/// Counts what Rust code allocates. What Embree allocates it counts itself.
#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// How many bytes are allocated now.
pub(crate) fn in_use() -> usize {
    ALLOCATOR.allocated()
}
