//! The programs that fuzz: whether they can be compiled, which there are, and how one is called.

use super::folders::{Folders, make};
use crate::steps::{Steps, cargo};
use std::process::{Command, Stdio};

/// Something to fuzz.
pub(super) struct Target {
    pub(super) name: String,
    /// How many bytes an input has at most.
    max_len: usize,
}

/// Says what is missing.
pub(super) fn check_tools() -> Result<(), String> {
    let mut version = cargo();
    version.args(["fuzz", "--version"]).stdout(Stdio::null()).stderr(Stdio::null());
    if version.status().is_ok_and(|status| status.success()) {
        return Ok(());
    }
    let needed = "cargo-fuzz is not installed. Get it by `cargo install cargo-fuzz`; it needs a C++ compiler, and \
                  Linux or macOS. What was found before is run by `cargo test -p kdray-tests --test fuzz`, without it";
    Err(needed.to_owned())
}

/// All targets; their seeds are written.
pub(super) fn targets(folders: &Folders) -> Result<Vec<Target>, String> {
    let mut command = cargo();
    command.args(["run", "--quiet", "-p", "kdray-tests", "--bin", "fuzz_seeds", "--"]);
    let output = command.arg(folders.work("seeds")).stderr(Stdio::inherit()).output();
    let output = output.map_err(|error| format!("cannot start cargo: {error}"))?;
    if !output.status.success() {
        return Err("the seeds cannot be written".to_owned());
    }
    let lines = String::from_utf8_lossy(&output.stdout).into_owned();
    let targets = lines.lines().filter_map(|line| {
        let (name, max_len) = line.split_once(' ')?;
        Some(Target { name: name.to_owned(), max_len: max_len.parse().ok()? })
    });
    Ok(targets.collect())
}

/// Compiles the programs. The flags that they need are unstable ones, also where rustc is stable.
pub(super) fn build(folders: &Folders, targets: &[Target]) -> Result<(), String> {
    let mut steps = Steps::new();
    let home = folders.home().display().to_string();
    let target = folders.target().display().to_string();
    let mut arguments = ["fuzz", "build", "--fuzz-dir", &home, "--target-dir", &target].to_vec();
    if let [only] = targets {
        arguments.push(&only.name);
    }
    let arguments: Vec<_> = arguments.into_iter().map(str::to_owned).collect();
    steps.cargo_with("programs", &arguments, &[("RUSTC_BOOTSTRAP", "1")])
}

/// A call of a target's program, with the flags that all calls need.
pub(super) fn program(folders: &Folders, target: &Target) -> Result<Command, String> {
    let path = folders.target().join(host()?).join("release").join(&target.name);
    let artifacts = folders.artifacts().join(&target.name);
    make(&artifacts)?;
    let mut command = Command::new(path);
    command.arg(format!("-artifact_prefix={}/", artifacts.display()));
    command.arg(format!("-max_len={}", target.max_len));
    // Seconds and megabytes that no input may take.
    command.args(["-timeout=20", "-rss_limit_mb=2048"]);
    command.env("RAYON_NUM_THREADS", "1").stdin(Stdio::null()).stdout(Stdio::null());
    Ok(command)
}

/// The processor and system that rustc compiles for.
fn host() -> Result<String, String> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let output = Command::new(rustc).arg("-vV").output().map_err(|error| error.to_string())?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let host = text.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned).ok_or_else(|| "rustc does not tell its host".to_owned())
}
