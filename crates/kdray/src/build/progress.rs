//! How far a build is, and whether to go on.

use super::BuildError;
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};

/// How far a build is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct BuildProgress {
    /// The part that is done, from 0 to 1, never falling.
    pub fraction: f64,
}

type Callback<'a> = &'a (dyn Fn(BuildProgress) -> ControlFlow<()> + Sync);

/// Counts the work done on all threads, and asks the caller now and then whether to go on.
///
/// The root is given [`WHOLE`](Self::WHOLE) units; children share their parent's in proportion to
/// the primitives they hold, and leaves pay theirs in.
pub(crate) struct Progress<'a> {
    callback: Callback<'a>,
    done: AtomicU64,
    cancelled: AtomicBool,
    /// What was last told. One thread at a time talks to the caller.
    told: Mutex<u64>,
}

impl<'a> Progress<'a> {
    /// The units of the whole build.
    pub(crate) const WHOLE: u64 = 1 << 32;

    /// Units that are worth a report.
    pub(super) const STEP: u64 = Self::WHOLE >> 8;

    pub(crate) fn new(callback: Callback<'a>) -> Self {
        let (done, cancelled) = (AtomicU64::new(0), AtomicBool::new(false));
        Self { callback, done, cancelled, told: Mutex::new(0) }
    }

    /// Whether some thread was told to stop.
    pub(crate) fn check(&self) -> Result<(), BuildError> {
        if self.cancelled.load(Relaxed) { Err(BuildError::Cancelled) } else { Ok(()) }
    }

    /// Adds `units` to what is done, and reports unless another thread does just now. After the
    /// answer to stop nothing is reported any more.
    pub(crate) fn add(&self, units: u64) -> Result<(), BuildError> {
        self.done.fetch_add(units, Relaxed);
        if let Ok(mut told) = self.told.try_lock() {
            self.check()?;
            *told = self.done.load(Relaxed).max(*told);
            let fraction = *told as f64 / Self::WHOLE as f64;
            if (self.callback)(BuildProgress { fraction }).is_break() {
                self.cancelled.store(true, Relaxed);
            }
        }
        self.check()
    }

    /// Adds all that was not yet added.
    pub(crate) fn finish(&self) -> Result<(), BuildError> {
        self.add(Self::WHOLE.saturating_sub(self.done.load(Relaxed)))
    }
}
