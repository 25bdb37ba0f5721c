//! Threads to work on, which are kept from call to call.

use crate::error::argument;
use pyo3::PyResult;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::collections::HashMap;
use std::num::NonZeroUsize;
use std::ops::Deref;
use std::sync::{Arc, LazyLock, Mutex, MutexGuard, PoisonError};
use std::thread::available_parallelism;

/// The most threads that a call may ask for.
const MOST: usize = 1024;

/// The environment variables that say how many threads there are where no argument does, the first first.
const VARIABLES: [&str; 2] = ["KDRAY_THREADS", "RAYON_NUM_THREADS"];

/// So many idle pools of a size are kept however large they are: for two threads of Python that ask in turns.
const KEPT: usize = 2;

/// The process that made a pool, for those of a parent do not live on in its children, and the number of threads.
type Key = (u32, usize);

/// Those that nobody works on.
type Idle = HashMap<Key, Vec<Arc<ThreadPool>>>;

static IDLE: LazyLock<Mutex<Idle>> = LazyLock::new(Mutex::default);

/// A pool that no other call works on: until it is dropped, when it is kept for the next.
#[derive(Debug)]
pub(crate) struct Lent {
    key: Key,
    pool: Arc<ThreadPool>,
}

impl Deref for Lent {
    type Target = ThreadPool;

    fn deref(&self) -> &ThreadPool {
        &self.pool
    }
}

impl Drop for Lent {
    fn drop(&mut self) {
        let most = (processors() / self.key.1).max(KEPT);
        let mut idle = idle();
        let pools = idle.entry(self.key).or_default();
        if pools.len() < most {
            pools.push(Arc::clone(&self.pool));
        }
    }
}

/// So many threads, or as many as the environment says, or as there are processors.
pub(crate) fn threads(asked: Option<i64>) -> PyResult<usize> {
    let in_range = |name, count: Option<usize>| {
        let count = count.filter(|count| (1..=MOST).contains(count));
        count.ok_or_else(|| argument(name, format!("give a whole number from 1 to {MOST}")))
    };
    if let Some(asked) = asked {
        return in_range("threads", usize::try_from(asked).ok());
    }
    let given = VARIABLES.map(|name| (name, std::env::var(name).unwrap_or_default()));
    // An empty variable is none; rayon takes zero for as many as there are processors.
    match given.iter().find(|(_, text)| !text.is_empty() && text != "0") {
        Some((name, text)) => in_range(name, text.trim().parse().ok()),
        None => Ok(processors().min(MOST)),
    }
}

/// A pool of so many threads, of the caller's own: calls of several threads of Python that shared one would wait for
/// each other.
pub(crate) fn pool(threads: usize) -> PyResult<Lent> {
    let key = (std::process::id(), threads);
    let kept = idle().get_mut(&key).and_then(Vec::pop);
    let pool = kept.map_or_else(|| made(threads).map(Arc::new), Ok)?;
    Ok(Lent { key, pool })
}

fn made(threads: usize) -> PyResult<ThreadPool> {
    let builder = ThreadPoolBuilder::new().num_threads(threads);
    let pool = builder.thread_name(|index| format!("kdray {index}")).build();
    pool.map_err(|error| argument("threads", error))
}

fn idle() -> MutexGuard<'static, Idle> {
    IDLE.lock().unwrap_or_else(PoisonError::into_inner)
}

fn processors() -> usize {
    available_parallelism().map_or(1, NonZeroUsize::get)
}
