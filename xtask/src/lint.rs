//! `cargo xtask lint`.

use crate::steps::{Steps, cargo, say};
use std::process::Stdio;

/// Runs every check that needs no program to be run.
pub(crate) fn run() -> Result<(), String> {
    let mut steps = Steps::new();
    let doc = [("RUSTDOCFLAGS", "-D warnings")];
    steps.cargo("format", "fmt --all --check", &[])?;
    steps.cargo("clippy", "clippy --workspace --all-targets -- -D warnings", &[])?;
    let bare = "clippy -p kdray --all-targets --no-default-features -- -D warnings";
    steps.cargo("clippy, library without default features", bare, &[])?;
    steps.cargo("documentation", "doc --workspace --no-deps", &doc)?;
    let private = "doc --workspace --no-deps --document-private-items";
    steps.cargo("documentation of private items", private, &doc)?;
    if has_deny() {
        steps.cargo("licences and advisories", "deny check", &[])?;
    } else {
        say("--- licences and advisories: SKIPPED, cargo-deny is not installed");
        say("    (cargo install cargo-deny; what it checks is in deny.toml)");
    }
    steps.finish("lint");
    Ok(())
}

fn has_deny() -> bool {
    let quiet =
        cargo().args(["deny", "--version"]).stdout(Stdio::null()).stderr(Stdio::null()).status();
    quiet.is_ok_and(|status| status.success())
}
