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

/// What the shell expects of a process that Ctrl-C ended: 128 + SIGINT.
pub(crate) const EXIT_CODE: u8 = 130;

static REQUESTED: AtomicBool = AtomicBool::new(false);
static WATCHERS: AtomicUsize = AtomicUsize::new(0);
static TEMPORARY_FILES: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Begins to listen for Ctrl-C, and for requests to terminate or to hang up, which count as such.
/// Whoever started the process may have it ignore one of them, as `nohup` does: it stays ignored,
/// and the others do what they do by themselves.
pub(crate) fn listen() {
    let stop = || {
        let again = REQUESTED.swap(true, Ordering::SeqCst);
        if again || WATCHERS.load(Ordering::SeqCst) == 0 {
            remove_temporary_files();
            std::process::exit(EXIT_CODE.into());
        }
    };
    // Without a handler Ctrl-C ends the process, which is good enough.
    let _ = ctrlc::try_set_handler(stop);
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
