//! How far the work is, on standard error.

use crate::cli::Globals;
use indicatif::{HumanCount, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::{
    fmt,
    io::{self, IsTerminal, Write},
    time::{Duration, Instant},
};

/// How far one piece of work is: on a terminal a bar with rate and time left; elsewhere one line
/// when it is done; with `--quiet` nothing.
pub(crate) struct Progress {
    bar: ProgressBar,
    quiet: bool,
    start: Instant,
}

impl Progress {
    /// Begins, for example, `("building the tree", 5000, "triangles", globals)`.
    pub(crate) fn start(what: &str, total: u64, unit: &str, globals: &Globals) -> Self {
        let shown = !globals.quiet && io::stderr().is_terminal();
        let target =
            if shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(Some(total), target).with_message(what.to_owned());
        let unit = unit.to_owned();
        let rate = move |state: &ProgressState, text: &mut dyn fmt::Write| {
            // Nothing can be done if a line on a terminal cannot be put together.
            let _ = write!(text, "{} {unit}/s", HumanCount(state.per_sec() as u64));
        };
        let template = "{msg} [{bar:30}] {percent:>3} %  {rate}, {eta} left";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style.with_key("rate", rate).progress_chars("=> "));
        }
        Self { bar, quiet: globals.quiet, start: Instant::now() }
    }

    /// Begins work of unknown extent, such as reading a file.
    pub(crate) fn spin(what: &str, globals: &Globals) -> Self {
        let progress = Self::start(what, 0, "", globals);
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {elapsed}") {
            progress.bar.set_style(style);
        }
        progress.bar.enable_steady_tick(Duration::from_millis(100));
        progress
    }

    /// Begins work that shows no bar.
    pub(crate) fn unseen(globals: &Globals) -> Self {
        Self { bar: ProgressBar::hidden(), quiet: globals.quiet, start: Instant::now() }
    }

    /// So much of the total is done.
    pub(crate) fn set(&self, done: u64) {
        self.bar.set_position(done);
    }

    /// So much more is done; from any thread.
    pub(crate) fn advance(&self, more: u64) {
        self.bar.inc(more);
    }

    /// This part of the total is done, from 0 to 1.
    pub(crate) fn set_fraction(&self, fraction: f64) {
        self.set((fraction * self.bar.length().unwrap_or(0) as f64) as u64);
    }

    /// How long it has taken so far.
    pub(crate) fn elapsed(&self) -> Duration {
        self.start.elapsed()
    }

    /// Takes the bar away and says in a line what was done.
    pub(crate) fn finish(self, line: &str) {
        self.bar.finish_and_clear();
        if !self.quiet {
            note(line);
        }
    }
}

/// Takes the bar away when the work fails.
impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// A line on standard error for the user, unless `--quiet`.
pub(crate) fn say(globals: &Globals, line: &str) {
    if !globals.quiet {
        note(line);
    }
}

fn note(line: &str) {
    // Nothing can be done if standard error is closed.
    let _ = writeln!(io::stderr().lock(), "{line}");
}
