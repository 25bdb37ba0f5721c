//! What CI and the README call: `cargo xtask lint`, `cargo xtask test`.

mod lint;
mod steps;
mod test;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// The project's chores.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", disable_help_subcommand = true)]
struct Arguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Format, clippy, documentation, and licences if cargo-deny is installed.
    Lint,
    /// All tests: of every crate, of the documentation, of the examples.
    Test,
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().task {
        Task::Lint => lint::run(),
        Task::Test => test::run(),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            steps::say(&format!("xtask: {failure}"));
            ExitCode::FAILURE
        }
    }
}
