//! Threads to work on, which are kept from call to call.

use crate::error::{KdrayError, argument};
use pyo3::{PyErr, PyResult};
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::collections::VecDeque;
use std::mem;
use std::num::NonZeroUsize;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::available_parallelism;

/// The most threads that a call may ask for.
const MOST: usize = 1024;

/// The argument that says how many there are.
const ARGUMENT: &str = "threads";

/// The environment variables that say so where no argument does, the first first.
const VARIABLES: [&str; 2] = ["KDRAY_THREADS", "RAYON_NUM_THREADS"];

/// For so many calls at once, each on all processors, idle threads are kept.
const KEPT: usize = 2;

/// How many threads a call is to have.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Threads {
    count: usize,
    /// The argument or the variable that says so; none where it is the number of processors.
    name: Option<&'static str>,
}

/// The pools of this process.
#[derive(Debug)]
struct Pools {
    /// Its id: pools of a parent do not live on in its children.
    process: u32,
    /// How many threads calls have.
    lent: usize,
    /// Those that nobody works on, the last used last.
    idle: VecDeque<ThreadPool>,
}

static POOLS: Mutex<Pools> = Mutex::new(Pools { process: 0, lent: 0, idle: VecDeque::new() });

/// Threads that a call has until this is dropped.
#[derive(Debug)]
struct Lent {
    process: u32,
    count: usize,
}

impl Lent {
    /// Threads for a call, and their pool if there is one.
    fn new(threads: Threads) -> (Self, Option<ThreadPool>) {
        let mut pools = pools();
        let count = match threads.name {
            Some(ARGUMENT) => threads.count,
            _ => share(threads.count, pools.lent),
        };
        pools.lent += count;
        let place = pools.idle.iter().rposition(|pool| pool.current_num_threads() == count);
        let kept = place.and_then(|place| pools.idle.remove(place));
        (Self { process: pools.process, count }, kept)
    }

    /// Gives the pool back, for the next call. Of those that were not used for longest, some end: so many that no
    /// more threads are left than `KEPT` says, or this pool alone.
    fn keep(self, pool: ThreadPool) {
        let (mut pools, most) = (pools(), KEPT * processors());
        if pools.process != self.process {
            // This is a fork, within a call.
            mem::forget(pool);
            return;
        }
        pools.idle.push_back(pool);
        let mut threads = 0;
        let fits = |pool: &&ThreadPool| {
            threads += pool.current_num_threads();
            threads <= most
        };
        let kept = pools.idle.iter().rev().take_while(fits).count().max(1);
        let ended = pools.idle.len() - kept;
        pools.idle.drain(..ended);
    }
}

impl Drop for Lent {
    fn drop(&mut self) {
        let mut pools = pools();
        if pools.process == self.process {
            pools.lent -= self.count;
        }
    }
}

/// How many of `most` threads a call gets that did not say how many it wants: all, unless as many are lent; then half
/// of what is left of twice as many, and at least one.
fn share(most: usize, lent: usize) -> usize {
    match lent < most {
        true => most,
        false => ((2 * most).saturating_sub(lent) / 2).max(1),
    }
}

/// So many threads, or as many as the environment says, or as there are processors.
pub(crate) fn threads(asked: Option<i64>) -> PyResult<Threads> {
    let in_range = |name, count: Option<usize>| {
        let count = count.filter(|count| (1..=MOST).contains(count));
        let count =
            count.ok_or_else(|| argument(name, format!("give a whole number from 1 to {MOST}")))?;
        Ok(Threads { count, name: Some(name) })
    };
    if let Some(asked) = asked {
        return in_range(ARGUMENT, usize::try_from(asked).ok());
    }
    let given = VARIABLES.map(|name| (name, std::env::var(name).unwrap_or_default()));
    // An empty variable is none; rayon takes zero for as many as there are processors.
    match given.iter().find(|(_, text)| !text.is_empty() && text != "0") {
        Some((name, text)) => in_range(name, text.trim().parse().ok()),
        None => Ok(Threads { count: processors().min(MOST), name: None }),
    }
}

/// Does `work` on a pool that it has for itself: calls of several threads of Python that shared one would wait for each
/// other. It has so many threads; fewer if they are not those of an argument, and others work.
pub(crate) fn on_pool<R>(threads: Threads, work: impl FnOnce(&ThreadPool) -> R) -> PyResult<R> {
    let (lent, kept) = Lent::new(threads);
    let made = || made(lent.count).map_err(|error| refused(threads.name, &error));
    let pool = kept.map_or_else(made, Ok)?;
    let answer = work(&pool);
    lent.keep(pool);
    Ok(answer)
}

fn made(threads: usize) -> Result<ThreadPool, ThreadPoolBuildError> {
    let builder = ThreadPoolBuilder::new().num_threads(threads);
    builder.thread_name(|index| format!("kdray {index}")).build()
}

/// That the system has no threads for a call.
fn refused(name: Option<&str>, error: &ThreadPoolBuildError) -> PyErr {
    let reason = format!("the system does not start as many threads: {error}");
    match name {
        Some(name) => argument(name, format!("{reason}; give fewer")),
        None => KdrayError::new_err(format!("{reason}; give fewer by threads or {}", VARIABLES[0])),
    }
}

fn pools() -> MutexGuard<'static, Pools> {
    let mut pools = POOLS.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    if pools.process != process {
        // To end what a parent made would be to wake threads that are not there.
        mem::forget(mem::take(&mut pools.idle));
        (pools.process, pools.lent) = (process, 0);
    }
    pools
}

fn processors() -> usize {
    available_parallelism().map_or(1, NonZeroUsize::get)
}
