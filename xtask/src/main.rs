//! What CI and the README call: `cargo xtask lint`, `cargo xtask test`, and the long checks.

#![forbid(unsafe_code)]

mod agree;
mod attack;
mod bench;
mod fuzz;
mod lint;
mod package;
mod parity;
mod peers;
mod pixels;
mod python;
mod python_bench;
mod steps;
mod test;
mod venv;

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
    /// All tests: of every crate, of the documentation, of the examples, of the Python package.
    Test,
    /// Only the tests of the Python package, in a virtual environment.
    Python,
    /// Every tree against the naive answer on real scenes, in a release build.
    Agree(agree::Options),
    /// Rays at every vertex and edge of closed meshes: `count` must be even. In a release build.
    Parity(parity::Options),
    /// Rays that are aimed to break kdray, at closed and awkward meshes; every answer must be right. In a
    /// release build.
    Attack(attack::Options),
    /// Every loader, tree files, builds and queries on inputs that a fuzzer makes up; needs cargo-fuzz.
    Fuzz(fuzz::Options),
    /// kdray beside Embree and other libraries: rays a second, build times, memory, wrong answers. With `python`
    /// the Python package beside trimesh and Open3D.
    #[command(disable_help_flag = true)]
    Bench(bench::Options),
    /// Pictures of real scenes: every strategy must give the same, byte for byte.
    Pixels(pixels::Options),
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().task {
        Task::Lint => lint::run(),
        Task::Test => test::run(),
        Task::Python => python::run(&mut steps::Steps::new()),
        Task::Agree(options) => agree::run(&options),
        Task::Parity(options) => parity::run(&options),
        Task::Attack(options) => attack::run(&options),
        Task::Fuzz(options) => fuzz::run(&options),
        Task::Bench(options) => bench::run(options),
        Task::Pixels(options) => pixels::run(&options),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            steps::say(&format!("xtask: {failure}"));
            ExitCode::FAILURE
        }
    }
}
