//! Work on several threads if the feature `rayon` is on, and the same work on one if not.

/// Runs both, `a` on this thread and `b` perhaps on another.
#[cfg(feature = "rayon")]
pub(super) fn join<A: Send, B: Send>(
    a: impl FnOnce() -> A + Send,
    b: impl FnOnce() -> B + Send,
) -> (A, B) {
    rayon::join(a, b)
}

/// Runs `a`, then `b`.
#[cfg(not(feature = "rayon"))]
pub(super) fn join<A, B>(a: impl FnOnce() -> A, b: impl FnOnce() -> B) -> (A, B) {
    (a(), b())
}

/// Runs both on this thread, or as [`join`] does if they are `large`.
pub(super) fn join_if<A: Send, B: Send>(
    large: bool,
    a: impl FnOnce() -> A + Send,
    b: impl FnOnce() -> B + Send,
) -> (A, B) {
    if large { join(a, b) } else { (a(), b()) }
}

/// `f` of all numbers below `end`, in order.
#[cfg(feature = "rayon")]
pub(super) fn map_range<T: Send>(end: u32, f: impl Fn(u32) -> T + Sync) -> Vec<T> {
    use rayon::prelude::*;
    (0..end).into_par_iter().map(&f).collect()
}

/// `f` of all numbers below `end`, in order.
#[cfg(not(feature = "rayon"))]
pub(super) fn map_range<T>(end: u32, f: impl Fn(u32) -> T) -> Vec<T> {
    (0..end).map(f).collect()
}

/// Sorts; equal items cannot be told apart.
#[cfg(feature = "rayon")]
pub(super) fn sort<T: Ord + Send>(items: &mut [T]) {
    use rayon::prelude::*;
    items.par_sort_unstable();
}

/// Sorts; equal items cannot be told apart.
#[cfg(not(feature = "rayon"))]
pub(super) fn sort<T: Ord>(items: &mut [T]) {
    items.sort_unstable();
}
