//! `cargo xtask fuzz`.

mod again;
mod folders;
mod keep;
mod ledger;
mod programs;
mod session;
mod watch;

use crate::steps::say;
use clap::Args;
use folders::Folders;
use ledger::Ledger;
use programs::Target;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// What is fuzzed; see `tests/src/fuzz`.
#[derive(Args)]
pub(crate) struct Options {
    /// So many minutes for each target.
    #[arg(long, default_value_t = 5.0)]
    minutes: f64,
    /// Only targets whose names contain one of these, separated by commas.
    #[arg(long, value_delimiter = ',')]
    targets: Vec<String>,
    /// What watches memory: none, for all but one call of what kdray is made of is safe Rust, or address, which
    /// takes much longer to compile.
    #[arg(long, default_value = "none")]
    sanitizer: String,
    /// Instead make the corpora in the repository anew, of what was found so far, as small as covers the same.
    #[arg(long)]
    keep: bool,
}

/// Runs each target in turn, or keeps what they found.
pub(crate) fn run(options: &Options) -> Result<(), String> {
    if !(options.minutes > 0.0 && options.minutes < 1e6) {
        return Err("--minutes: give a number above 0".to_owned());
    }
    programs::check_tools()?;
    let folders = Folders::new();
    let targets = chosen(programs::targets(&folders)?, &options.targets)?;
    programs::build(&folders, &options.sanitizer)?;
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    // The program that is running gets the signal as well, and ends in order.
    let listening = ctrlc::set_handler(move || flag.store(true, Ordering::SeqCst));
    listening.map_err(|error| format!("Ctrl-C cannot be watched: {error}"))?;
    let mut ledger = Ledger::read(&folders);
    for (index, target) in targets.iter().enumerate() {
        if stop.load(Ordering::SeqCst) {
            break;
        }
        say(&format!("--- {} ({} of {})", target.name, index + 1, targets.len()));
        if options.keep {
            keep::keep(&folders, target, &stop)?;
        } else {
            again::run(&folders, target, &stop)?;
            let limit = Duration::from_secs_f64(60.0 * options.minutes);
            let spent = session::run(&folders, target, limit, &stop)?;
            ledger.add(&folders, &target.name, spent)?;
        }
    }
    say(&ledger.table(&folders, &targets));
    match targets.iter().map(|target| folders.failures(&target.name)).sum() {
        0 => Ok(()),
        count => Err(format!("{count} inputs fail; they are in {}", folders.artifacts().display())),
    }
}

/// The targets that are wanted.
fn chosen(targets: Vec<Target>, names: &[String]) -> Result<Vec<Target>, String> {
    let known: Vec<_> = targets.iter().map(|target| target.name.clone()).collect();
    let is_wanted = |target: &Target| {
        names.is_empty() || names.iter().any(|name| target.name.contains(name.as_str()))
    };
    let chosen: Vec<_> = targets.into_iter().filter(is_wanted).collect();
    if chosen.is_empty() {
        return Err(format!("--targets: there are only {}", known.join(", ")));
    }
    Ok(chosen)
}
