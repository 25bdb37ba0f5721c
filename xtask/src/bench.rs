//! `cargo xtask bench`.

use crate::steps::Steps;
use clap::Args;

/// Handed on to the bench, which has its own help.
#[derive(Args)]
pub(crate) struct Options {
    /// See `cargo xtask bench --help` and bench/README.md.
    #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
    arguments: Vec<String>,
}

/// Builds and runs the bench.
pub(crate) fn run(options: Options) -> Result<(), String> {
    let run = ["run", "--release", "-p", "kdray-bench", "--"];
    let arguments = run.into_iter().map(str::to_owned).chain(options.arguments).collect::<Vec<_>>();
    Steps::new().cargo_with("comparison", &arguments, &[])
}
