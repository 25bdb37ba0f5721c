//! Inputs that failed in earlier runs, once more.

use super::folders::{Folders, make};
use super::programs::{Target, program};
use crate::steps::{say, told};
use std::fs;
use std::process::Stdio;
use std::sync::atomic::{AtomicBool, Ordering};

/// Runs every input at which a target failed before, and puts aside those that do no harm any more: so that what
/// was mended is no failure for ever.
pub(super) fn run(folders: &Folders, target: &Target, stop: &AtomicBool) -> Result<(), String> {
    let name = &target.name;
    let (mended, again) = (folders.work("mended").join(name), folders.work("again").join(name));
    let entries = fs::read_dir(folders.artifacts().join(name)).into_iter().flatten();
    let files: Vec<_> = entries.filter_map(Result::ok).collect();
    for file in &files {
        if stop.load(Ordering::SeqCst) {
            return Ok(());
        }
        [&mended, &again].into_iter().try_for_each(|folder| make(folder))?;
        let mut command = program(folders, target)?;
        // The last one counts: what fails again is there already.
        command.arg(format!("-artifact_prefix={}/", again.display()));
        let status = command.arg(file.path()).stderr(Stdio::null()).status();
        if status.map_err(|error| format!("{name}: cannot be started: {error}"))?.success() {
            let aside = mended.join(file.file_name());
            fs::rename(file.path(), &aside).map_err(|error| told(&aside, &error))?;
        }
    }
    if !files.is_empty() {
        let (before, now) = (files.len(), folders.failures(name));
        say(&format!("    {name}: of {before} inputs that failed {now} still do"));
    }
    Ok(())
}
