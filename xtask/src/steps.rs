//! Running cargo, step by step, and saying how long each step took.

use std::process::Command;
use std::time::Instant;

/// Steps that are run one after the other; the first that fails ends the task.
pub(crate) struct Steps {
    started: Instant,
    count: usize,
}

impl Steps {
    /// None so far.
    pub(crate) fn new() -> Self {
        Self { started: Instant::now(), count: 0 }
    }

    /// Runs `cargo` with the given arguments, separated by blanks, and environment variables.
    pub(crate) fn cargo(
        &mut self,
        what: &str,
        arguments: &str,
        environment: &[(&str, &str)],
    ) -> Result<(), String> {
        let arguments: Vec<String> = arguments.split_whitespace().map(str::to_owned).collect();
        self.cargo_with(what, &arguments, environment)
    }

    /// The same for arguments that may contain blanks.
    pub(crate) fn cargo_with(
        &mut self,
        what: &str,
        arguments: &[String],
        environment: &[(&str, &str)],
    ) -> Result<(), String> {
        self.count += 1;
        let line = format!("cargo {}", arguments.join(" "));
        say(&format!("--- {what}: {line}"));
        let started = Instant::now();
        let status = cargo().args(arguments).envs(environment.iter().copied()).status();
        let seconds = started.elapsed().as_secs_f64();
        match status {
            Ok(status) if status.success() => {
                say(&format!("--- {what}: done in {seconds:.1} s"));
                Ok(())
            }
            Ok(status) => Err(format!("{what} failed after {seconds:.1} s ({status}): {line}")),
            Err(error) => Err(format!("{what}: cannot start cargo: {error}")),
        }
    }

    /// Says that all is well.
    pub(crate) fn finish(self, task: &str) {
        let seconds = self.started.elapsed().as_secs_f64();
        say(&format!("=== {task}: all {} steps passed in {seconds:.1} s", self.count));
    }
}

/// Checks, before anything is compiled, that the large scenes are there.
pub(crate) fn need_scenes() -> Result<(), String> {
    let listing = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/scenes/scenes.json");
    match std::path::Path::new(listing).exists() {
        true => Ok(()),
        false => Err("this check needs large scenes, which are not part of the repository: a \
                      folder ../shared/scenes beside the checkout, with a scenes.json"
            .to_owned()),
    }
}

/// The cargo that runs this program.
pub(crate) fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// Tells the person at the terminal.
#[expect(clippy::print_stderr, reason = "a chore's progress belongs on standard error")]
pub(crate) fn say(line: &str) {
    eprintln!("{line}");
}
