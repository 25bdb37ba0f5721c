//! Threads to build with.

use crate::error::BenchError;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// So many threads, on which whatever uses rayon runs.
pub(crate) struct Workers {
    /// How many.
    pub(crate) count: usize,
    pool: ThreadPool,
}

impl Workers {
    /// Starts `count` threads.
    pub(crate) fn new(count: usize) -> Result<Self, BenchError> {
        let pool = ThreadPoolBuilder::new().num_threads(count).build();
        let pool = pool.map_err(|error| BenchError::Usage(format!("{count} threads: {error}")))?;
        Ok(Self { count, pool })
    }

    /// Runs `work` on these threads.
    pub(crate) fn run<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        self.pool.install(work)
    }
}
