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

/// Fewer items stay on this thread, so that a build of a small mesh never waits for the pool: whoever builds one in a
/// task of the pool, under a lock or in a `OnceLock`, would be given another such task meanwhile, and wait for itself.
#[cfg(feature = "rayon")]
const FEW: u32 = 1 << 12;

/// `f` of all numbers below `end`, in order.
#[cfg(feature = "rayon")]
pub(super) fn map_range<T: Send>(end: u32, f: impl Fn(u32) -> T + Sync) -> Vec<T> {
    use rayon::prelude::*;
    if end < FEW {
        return (0..end).map(f).collect();
    }
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
    if items.len() < 2 * FEW as usize {
        return items.sort_unstable();
    }
    items.par_sort_unstable();
}

/// Sorts; equal items cannot be told apart.
#[cfg(not(feature = "rayon"))]
pub(super) fn sort<T: Ord>(items: &mut [T]) {
    items.sort_unstable();
}

/// What `f` makes of pieces of at most `size` items, added up by `add`.
pub(super) fn fold<T: Sync, R: Send>(
    items: &[T],
    size: usize,
    f: &(impl Fn(&[T]) -> R + Sync),
    add: &(impl Fn(R, R) -> R + Sync),
) -> R {
    if items.len() <= size {
        return f(items);
    }
    let (first, second) = items.split_at(items.len() / 2);
    let (a, b) = join(|| fold(first, size, f, add), || fold(second, size, f, add));
    add(a, b)
}

/// `f` of all pieces of `size` items, in order; the last may be smaller.
#[cfg(feature = "rayon")]
pub(super) fn map_pieces<T: Send, R: Send>(
    items: &mut [T],
    size: usize,
    f: impl Fn(&mut [T]) -> R + Sync,
) -> Vec<R> {
    use rayon::prelude::*;
    items.par_chunks_mut(size).map(&f).collect()
}

/// `f` of all pieces of `size` items, in order; the last may be smaller.
#[cfg(not(feature = "rayon"))]
pub(super) fn map_pieces<T, R>(items: &mut [T], size: usize, f: impl Fn(&mut [T]) -> R) -> Vec<R> {
    items.chunks_mut(size).map(f).collect()
}

/// `f` of all items, in order.
#[cfg(feature = "rayon")]
pub(crate) fn map_all<T: Send, R: Send>(items: Vec<T>, f: impl Fn(T) -> R + Sync) -> Vec<R> {
    use rayon::prelude::*;
    if items.len() < 2 {
        return items.into_iter().map(&f).collect();
    }
    items.into_par_iter().with_max_len(1).map(&f).collect()
}

/// `f` of all items, in order.
#[cfg(not(feature = "rayon"))]
pub(crate) fn map_all<T, R>(items: Vec<T>, f: impl Fn(T) -> R) -> Vec<R> {
    items.into_iter().map(f).collect()
}

#[cfg(all(test, feature = "rayon"))]
mod tests {
    use super::*;
    use std::thread;

    #[test]
    fn few_items_stay_on_this_thread() {
        let here = thread::current().id();
        let all_here = |end: u32| map_range(end, |_| thread::current().id() == here);
        assert!(all_here(FEW - 1).into_iter().all(|is_here| is_here));
        // A thread that is none of the pool's waits for it.
        assert!(all_here(FEW).into_iter().all(|is_here| !is_here));
    }
}
