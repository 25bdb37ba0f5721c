//! `cargo xtask lint`.

use crate::steps::{Steps, cargo, say};
use std::path::Path;
use std::process::{Command, Stdio};

/// A target whose kernels are not those of x86-64.
const OTHER_PROCESSOR: &str = "aarch64-unknown-linux-gnu";

/// Runs every check that needs no program to be run.
pub(crate) fn run() -> Result<(), String> {
    let mut steps = Steps::new();
    let doc = [("RUSTDOCFLAGS", "-D warnings")];
    steps.cargo("format", "fmt --all --check", &[])?;
    // A workspace of its own.
    let fuzzing = concat!(env!("CARGO_MANIFEST_DIR"), "/../fuzz/Cargo.toml");
    let arguments = ["fmt", "--check", "--manifest-path", fuzzing].map(str::to_owned);
    steps.cargo_with("format of the programs that fuzz", &arguments, &[])?;
    steps.cargo("clippy", "clippy --workspace --all-targets -- -D warnings", &[])?;
    let bare = "clippy -p kdray --all-targets --no-default-features -- -D warnings";
    steps.cargo("clippy, library without default features", bare, &[])?;
    steps.cargo("documentation", "doc --workspace --no-deps", &doc)?;
    let private = "doc --workspace --no-deps --document-private-items";
    steps.cargo("documentation of private items", private, &doc)?;
    if has_standard_library(OTHER_PROCESSOR) {
        let check = format!("check -p kdray --target {OTHER_PROCESSOR}");
        steps.cargo("types on another processor", &check, &[])?;
    } else {
        say("--- types on another processor: SKIPPED, its standard library is not installed");
        say(&format!("    (rustup target add {OTHER_PROCESSOR})"));
    }
    if has_deny() {
        steps.cargo("licences and advisories", "deny check", &[])?;
    } else {
        say("--- licences and advisories: SKIPPED, cargo-deny is not installed");
        say("    (cargo install cargo-deny; what it checks is in deny.toml)");
    }
    steps.finish("lint");
    Ok(())
}

/// Whether anything can be compiled for a target.
fn has_standard_library(target: &str) -> bool {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let folder =
        Command::new(rustc).args(["--print", "target-libdir", "--target", target]).output();
    folder.is_ok_and(|output| Path::new(String::from_utf8_lossy(&output.stdout).trim()).exists())
}

fn has_deny() -> bool {
    let quiet =
        cargo().args(["deny", "--version"]).stdout(Stdio::null()).stderr(Stdio::null()).status();
    quiet.is_ok_and(|status| status.success())
}
