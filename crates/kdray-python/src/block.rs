//! How many rays are read and answered at a time.

use crate::packet::common;
use crate::rays::Rays;
use crate::tree::{Kind, Tree};
use pyo3::PyResult;

/// They and their hits fit the second-level cache.
pub(crate) const BLOCK: usize = 1024;

/// The most of those that go in packets, which learn from each other how large they are best.
const PACKETS: usize = 8 * BLOCK;

/// There are to be so many blocks for each of several threads, if there are as many rays.
const SHARES: usize = 4;

/// How large blocks are: larger where rays may go in packets, by what the first of them are like.
pub(crate) fn block_size(tree: &Tree, rays: &Rays<'_>) -> PyResult<usize> {
    if rays.len() <= BLOCK || !matches!(tree.kind, Kind::F32(_)) {
        return Ok(BLOCK);
    }
    let mut first = Vec::new();
    rays.read(0..BLOCK, &mut first)?;
    let shares = match rayon::current_num_threads() {
        1 => 1,
        threads => SHARES * threads,
    };
    let share = rays.len().div_ceil(shares);
    let packets = share.next_multiple_of(BLOCK).min(PACKETS);
    Ok(if common(&first).is_some() { packets } else { BLOCK })
}
