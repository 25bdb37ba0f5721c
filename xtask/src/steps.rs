//! Running cargo, step by step, and saying how long each step took.

use std::path::{Path, PathBuf};
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

    /// The same, if the large scenes are there: checked before anything is compiled.
    pub(crate) fn on_scenes() -> Result<Self, String> {
        let listing = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/scenes/scenes.json");
        if Path::new(listing).exists() {
            return Ok(Self::new());
        }
        let needed = "this check needs large scenes, which are not part of the repository: a \
                      folder ../shared/scenes beside the checkout, with a scenes.json";
        Err(needed.to_owned())
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
        let line = format!("cargo {}", arguments.join(" "));
        let mut command = cargo();
        command.args(arguments).envs(environment.iter().copied());
        self.run(what, &mut command, &line)
    }

    /// Runs a program; `line` is how it is told.
    pub(crate) fn run(
        &mut self,
        what: &str,
        command: &mut Command,
        line: &str,
    ) -> Result<(), String> {
        self.count += 1;
        say(&format!("--- {what}: {line}"));
        let started = Instant::now();
        let status = command.status();
        let seconds = started.elapsed().as_secs_f64();
        match status {
            Ok(status) if status.success() => {
                say(&format!("--- {what}: done in {seconds:.1} s"));
                Ok(())
            }
            Ok(status) => Err(format!("{what} failed after {seconds:.1} s ({status}): {line}")),
            Err(error) => Err(format!("{what}: cannot start {}: {error}", first_word(line))),
        }
    }

    /// Runs a program of the crate `kdray-tests` in a release build.
    pub(crate) fn check(
        &mut self,
        what: &str,
        program: &str,
        options: Vec<String>,
    ) -> Result<(), String> {
        let run = ["run", "--release", "--quiet", "-p", "kdray-tests", "--bin", program, "--"];
        let arguments: Vec<String> = run.into_iter().map(str::to_owned).chain(options).collect();
        self.cargo_with(what, &arguments, &[])
    }

    /// Says that all is well.
    pub(crate) fn finish(self, task: &str) {
        let seconds = self.started.elapsed().as_secs_f64();
        say(&format!("=== {task}: all {} steps passed in {seconds:.1} s", self.count));
    }
}

fn first_word(line: &str) -> &str {
    line.split_whitespace().next().unwrap_or(line)
}

/// An option and its value, if it has one.
pub(crate) fn option(name: &str, value: Option<&String>) -> Vec<String> {
    value.map_or(Vec::new(), |value| vec![name.to_owned(), value.clone()])
}

/// The cargo that runs this program.
pub(crate) fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// Where cargo puts what it makes.
pub(crate) fn target_folder() -> PathBuf {
    let chosen = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    chosen.unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../target"))
}

/// What is wrong with a file.
pub(crate) fn told(path: &Path, error: &std::io::Error) -> String {
    format!("{}: {error}", path.display())
}

/// Tells the person at the terminal.
#[expect(clippy::print_stderr, reason = "a chore's progress belongs on standard error")]
pub(crate) fn say(line: &str) {
    eprintln!("{line}");
}
