//! Work on other threads, while the interpreter is free for others, and what the caller looks after meanwhile.

use crate::error;
use crate::pool::{self, Threads};
use pyo3::{Py, PyAny, PyErr, PyResult, Python};
use rayon::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering::Relaxed};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::time::Duration;

/// How often the caller looks whether somebody wants to end the work, and tells how far it is.
const TICK: Duration = Duration::from_millis(50);

/// How a call is carried out.
#[derive(Debug)]
pub(crate) struct Job {
    /// On how many threads.
    threads: Threads,
    /// What is told how far it is: a function of what is done and what there is in all.
    progress: Option<Py<PyAny>>,
}

/// What the work and its caller tell each other.
#[derive(Debug, Default)]
pub(crate) struct Control {
    done: AtomicU64,
    stopped: AtomicBool,
}

impl Control {
    /// Whether the work is to end.
    pub(crate) fn is_stopped(&self) -> bool {
        self.stopped.load(Relaxed)
    }

    /// Ends the work.
    pub(crate) fn stop(&self) {
        self.stopped.store(true, Relaxed);
    }

    /// That so much more is done.
    pub(crate) fn add(&self, more: usize) {
        self.done.fetch_add(more as u64, Relaxed);
    }

    /// That so much is done.
    pub(crate) fn set(&self, done: u64) {
        self.done.store(done, Relaxed);
    }
}

impl Job {
    /// By the arguments of a call.
    pub(crate) fn new(threads: Option<i64>, progress: Option<Py<PyAny>>) -> PyResult<Self> {
        Ok(Self { threads: pool::threads(threads)?, progress })
    }

    /// Does `work`, of `total` parts, on the threads of a pool. What Ctrl-C, or the function that is told of
    /// the progress, raises, ends it; a panic is an exception.
    pub(crate) fn run<R: Send>(
        &self,
        py: Python<'_>,
        total: u64,
        work: impl FnOnce(&Control) -> PyResult<R> + Send,
    ) -> PyResult<R> {
        let control = Control::default();
        let answer = py.detach(|| self.watched(&control, total, work))?;
        py.check_signals()?;
        self.tell(py, total, total)?;
        Ok(answer)
    }

    /// Answers so many questions: up to `few` at once on this thread, where handing them to others would take longer,
    /// unless somebody is told how far it is.
    pub(crate) fn answer<R: Send>(
        &self,
        py: Python<'_>,
        (count, few): (usize, usize),
        work: impl FnOnce(&Control) -> PyResult<R> + Send,
    ) -> PyResult<R> {
        if count <= few && self.progress.is_none() {
            return py.detach(|| caught(|| work(&Control::default())));
        }
        self.run(py, count as u64, work)
    }

    fn watched<R: Send>(
        &self,
        control: &Control,
        total: u64,
        work: impl FnOnce(&Control) -> PyResult<R> + Send,
    ) -> PyResult<R> {
        let answer = pool::on_pool(self.threads, |pool| {
            let (sender, receiver) = sync_channel(1);
            pool.in_place_scope(|scope| {
                scope.spawn(move |_| {
                    // The caller waits for it, or is gone with the channel.
                    let _ = sender.send(caught(|| work(control)));
                });
                self.awaited(&receiver, control, total)
            })
        });
        answer?
    }

    /// The answer, and until it is there, what is to be looked after.
    fn awaited<R>(
        &self,
        receiver: &Receiver<PyResult<R>>,
        control: &Control,
        total: u64,
    ) -> PyResult<R> {
        let mut raised = None;
        loop {
            match receiver.recv_timeout(TICK) {
                Ok(answer) => return raised.map_or(answer, Err),
                Err(RecvTimeoutError::Timeout) if raised.is_none() => {
                    raised = self.look(control, total).err();
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(error::of_panic(&"the work ended without an answer"));
                }
            }
        }
    }

    /// Looks whether the work is to end, and tells how far it is.
    fn look(&self, control: &Control, total: u64) -> PyResult<()> {
        let looked = Python::attach(|py| {
            py.check_signals()?;
            self.tell(py, control.done.load(Relaxed).min(total), total)
        });
        looked.inspect_err(|_| control.stop())
    }

    fn tell(&self, py: Python<'_>, done: u64, total: u64) -> PyResult<()> {
        let Some(progress) = &self.progress else { return Ok(()) };
        progress.call1(py, (done, total)).map(drop)
    }
}

fn caught<R>(work: impl FnOnce() -> PyResult<R>) -> PyResult<R> {
    let answer = catch_unwind(AssertUnwindSafe(work));
    answer.unwrap_or_else(|payload| Err(error::of_panic(&*payload)))
}

/// Does each part of the work, on all threads of the pool that this is called in, until one fails or all is to
/// end; of several that fail the first is told. A single part is done on this thread, whichever it is.
pub(crate) fn each_part<P: Send, S>(
    control: &Control,
    parts: Vec<P>,
    scratch: impl Fn() -> S + Send + Sync,
    work: impl Fn(&mut S, P) -> PyResult<()> + Send + Sync,
) -> PyResult<()> {
    // Those before one that failed may fail as well, and then it is theirs that is told, on any number of threads.
    let failed = AtomicUsize::new(usize::MAX);
    let one = |scratch: &mut S, (index, part): (usize, P)| {
        if control.is_stopped() || index > failed.load(Relaxed) {
            return Ok(());
        }
        work(scratch, part).inspect_err(|_: &PyErr| {
            failed.fetch_min(index, Relaxed);
        })
    };
    if parts.len() <= 1 {
        let mut scratch = scratch();
        return parts.into_iter().enumerate().try_for_each(|part| one(&mut scratch, part));
    }
    let parts = parts.into_par_iter().enumerate();
    let answers: Vec<PyResult<()>> = parts.map_init(scratch, one).collect();
    answers.into_iter().collect()
}
