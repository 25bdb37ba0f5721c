//! One run of one target.

use super::folders::{Folders, count, make};
use super::programs::{Target, program};
use super::watch::{Spent, watch};
use crate::steps::say;
use std::fs::{self, File};
use std::process::Stdio;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// Runs a target's program until the time is over, an input fails, or `stop` says so.
pub(super) fn run(
    folders: &Folders,
    target: &Target,
    limit: Duration,
    stop: &AtomicBool,
) -> Result<Spent, String> {
    let name = &target.name;
    let (found, logs) = (folders.found(name), folders.work("logs"));
    [&found, &logs, &folders.corpus(name)].into_iter().try_for_each(|folder| make(folder))?;
    let failed_before = folders.failures(name);
    let log = logs.join(name).with_extension("log");
    let file = File::create(&log).map_err(|error| format!("{}: {error}", log.display()))?;
    let mut command = program(folders, target)?;
    command.arg("-print_final_stats=1");
    command.arg(format!("-max_total_time={}", limit.as_secs_f64().ceil() as u64));
    // What is found goes into the first folder.
    command.arg(&found).arg(folders.corpus(name)).arg(folders.seeds(name));
    let child = command.stderr(Stdio::piped()).spawn();
    let mut child = child.map_err(|error| format!("{name}: cannot be started: {error}"))?;
    let spent = watch(&mut child, file, stop, |spent| {
        let rate = spent.executions as f64 / spent.wall.as_secs_f64();
        let (seconds, all) = (spent.wall.as_secs(), limit.as_secs());
        let found = count(&found);
        say(&format!(
            "    {name}: {seconds} of {all} s, {} executions, {rate:.0}/s, {found} inputs found",
            spent.executions
        ));
    });
    let status = child.wait().map_err(|error| error.to_string())?;
    if folders.failures(name) > failed_before {
        say(&format!("    {name}: AN INPUT FAILS, see {}", log.display()));
    } else if !status.success() && spent.executions == 0 {
        let told = fs::read_to_string(&log).unwrap_or_default();
        return Err(format!("{name} does not run ({status}): {told}"));
    }
    Ok(spent)
}
