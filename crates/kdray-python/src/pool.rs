//! Threads to work on, which are kept from call to call.

use crate::error::argument;
use pyo3::PyResult;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::collections::HashMap;
use std::num::NonZeroUsize;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};
use std::thread::available_parallelism;

/// The most threads that a call may ask for.
const MOST: usize = 1024;

/// The environment variables that say how many threads there are where no argument does, the first first.
const VARIABLES: [&str; 2] = ["KDRAY_THREADS", "RAYON_NUM_THREADS"];

/// The pools by the process that made them, for those of a parent do not live on in its children, and by
/// their number of threads.
type Pools = HashMap<(u32, usize), Arc<ThreadPool>>;

static POOLS: LazyLock<Mutex<Pools>> = LazyLock::new(Mutex::default);

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
        None => Ok(available_parallelism().map_or(1, NonZeroUsize::get).min(MOST)),
    }
}

/// The pool of so many threads.
pub(crate) fn pool(threads: usize) -> PyResult<Arc<ThreadPool>> {
    let mut pools = POOLS.lock().unwrap_or_else(PoisonError::into_inner);
    let key = (std::process::id(), threads);
    if let Some(pool) = pools.get(&key) {
        return Ok(Arc::clone(pool));
    }
    let builder = ThreadPoolBuilder::new().num_threads(threads);
    let pool = builder.thread_name(|index| format!("kdray {index}")).build();
    let pool = Arc::new(pool.map_err(|error| argument("threads", error))?);
    pools.insert(key, Arc::clone(&pool));
    Ok(pool)
}
