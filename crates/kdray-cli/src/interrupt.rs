//! Ctrl-C: ends the process at once, unless someone watches for it and ends in order.

use std::{
    fs,
    ops::ControlFlow,
    path::PathBuf,
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
};
#[cfg(unix)]
use {
    signal_hook::{
        consts::{SIGHUP, SIGINT, SIGTERM},
        iterator::Signals,
    },
    std::thread,
};

/// What the shell expects of a process that Ctrl-C ended: 128 + SIGINT.
pub(crate) const EXIT_CODE: u8 = 130;

static REQUESTED: AtomicBool = AtomicBool::new(false);
static WATCHERS: AtomicUsize = AtomicUsize::new(0);
static TEMPORARY_FILES: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Begins to listen for Ctrl-C, and for requests to terminate or to hang up, which count as such.
/// Whoever started the process may have it ignore one of them, as `nohup` does: on Linux it stays
/// ignored, and the others count.
///
/// On Unix by `signal-hook`, for `ctrlc` listens for all of them or, if one is ignored, for none.
pub(crate) fn listen() {
    // Without a handler Ctrl-C ends the process, which is good enough.
    #[cfg(unix)]
    if let Ok(mut signals) = Signals::new(wanted()) {
        thread::spawn(move || signals.forever().for_each(|_| stop()));
    }
    #[cfg(not(unix))]
    let _ = ctrlc::set_handler(stop);
}

/// The signals that the process was not told to ignore, as far as the system says so.
#[cfg(unix)]
fn wanted() -> Vec<i32> {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = ignored(&status).unwrap_or(0);
    let signals = [SIGINT, SIGTERM, SIGHUP].into_iter();
    signals.filter(|signal| (ignored >> (signal - 1)) & 1 == 0).collect()
}

/// The ignored signals in the words of Linux: the lowest bit is of signal 1.
#[cfg(unix)]
fn ignored(status: &str) -> Option<u64> {
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"))?;
    u64::from_str_radix(mask.trim(), 16).ok()
}

/// What a signal does.
fn stop() {
    let again = REQUESTED.swap(true, Ordering::SeqCst);
    if again || WATCHERS.load(Ordering::SeqCst) == 0 {
        remove_temporary_files();
        std::process::exit(EXIT_CODE.into());
    }
}

/// Has this file removed if Ctrl-C ends the process at once, which runs no destructors.
pub(crate) fn remove_at_exit(path: PathBuf) {
    TEMPORARY_FILES.lock().unwrap_or_else(PoisonError::into_inner).push(path);
}

fn remove_temporary_files() {
    for path in TEMPORARY_FILES.lock().unwrap_or_else(PoisonError::into_inner).drain(..) {
        // Those that were completed have another name by now.
        let _ = fs::remove_file(path);
    }
}

/// While it lives, the first Ctrl-C only makes [`requested`] true; a second one ends the process.
pub(crate) struct Watch(());

/// Promises to ask [`requested`] or [`flow`] often.
#[must_use = "Ctrl-C is watched only while the value lives"]
pub(crate) fn watch() -> Watch {
    WATCHERS.fetch_add(1, Ordering::SeqCst);
    Watch(())
}

impl Drop for Watch {
    fn drop(&mut self) {
        WATCHERS.fetch_sub(1, Ordering::SeqCst);
    }
}

/// Whether Ctrl-C was pressed.
pub(crate) fn requested() -> bool {
    REQUESTED.load(Ordering::SeqCst)
}

/// The same for progress callbacks.
pub(crate) fn flow() -> ControlFlow<()> {
    if requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn ignored_signals_are_read_from_what_linux_says() {
        let status = "Name:\tkdray\nSigBlk:\tffff\nSigIgn:\t0000000000001003\nSigCgt:\t0\n";
        assert_eq!(ignored(status), Some(0x1003));
        assert_eq!((ignored(""), ignored("SigIgn:\tx\n")), (None, None));
    }
}
