//! The programs that fuzz: whether they can be compiled, which there are, and how one is called.

use super::folders::{Folders, make};
use crate::steps::{Steps, cargo};
use std::fs;
use std::process::{Command, Stdio};

/// Something to fuzz.
pub(super) struct Target {
    pub(super) name: String,
    /// Flags of its own.
    flags: Vec<String>,
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

/// All targets, as the manifest of the programs lists them.
pub(super) fn targets(folders: &Folders) -> Result<Vec<Target>, String> {
    let mut list = cargo();
    let listed = list.args(["fuzz", "list", "--fuzz-dir"]).arg(folders.home()).output();
    let listed = listed.map_err(|error| format!("cannot start cargo: {error}"))?;
    let names = String::from_utf8_lossy(&listed.stdout).into_owned();
    names.lines().map(|name| Target::read(folders, name)).collect()
}

impl Target {
    /// Reads the flags of a target: lines such as `max_len = 512`.
    fn read(folders: &Folders, name: &str) -> Result<Self, String> {
        let file = folders.options(name);
        let text = fs::read_to_string(&file);
        let text = text.map_err(|error| format!("{}: {error}", file.display()))?;
        let flags = text.lines().filter_map(|line| match line.split_once(" = ")? {
            ("dict", path) => Some(format!("-dict={}", folders.home().join(path).display())),
            (key, value) => Some(format!("-{key}={value}")),
        });
        Ok(Self { name: name.to_owned(), flags: flags.collect() })
    }
}

/// Compiles the programs, with checks of overflow and all assertions. The flags that they need are unstable ones,
/// also where rustc is stable.
pub(super) fn build(folders: &Folders, sanitizer: &str) -> Result<(), String> {
    let mut steps = Steps::new();
    let home = folders.home().display().to_string();
    let target = folders.target().display().to_string();
    let places = ["fuzz", "build", "--fuzz-dir", &home, "--target-dir", &target];
    // One piece, which is what cargo-fuzz would make, takes longer to compile.
    let how = ["--codegen-units", "16", "--sanitizer", sanitizer];
    let arguments: Vec<_> = places.into_iter().chain(how).map(str::to_owned).collect();
    steps.cargo_with("programs", &arguments, &[("RUSTC_BOOTSTRAP", "1")])
}

/// A call of a target's program, with the flags that all calls need.
pub(super) fn program(folders: &Folders, target: &Target) -> Result<Command, String> {
    let path = folders.target().join(host()?).join("release").join(&target.name);
    let (artifacts, seeds) = (folders.artifacts().join(&target.name), folders.seeds(&target.name));
    [&artifacts, &seeds].into_iter().try_for_each(|folder| make(folder))?;
    let mut command = Command::new(path);
    command.arg(format!("-artifact_prefix={}/", artifacts.display()));
    command.args(&target.flags);
    // Seconds and megabytes that no input may take.
    command.args(["-timeout=20", "-rss_limit_mb=2048"]);
    command
        .env("RAYON_NUM_THREADS", "1")
        .env("KDRAY_SEEDS", seeds)
        .stdin(Stdio::null())
        .stdout(Stdio::null());
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
