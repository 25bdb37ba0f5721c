//! `cargo xtask bench`.

use crate::python_bench;
use crate::steps::Steps;
use clap::Args;

/// Handed on to the bench, which has its own help.
#[derive(Args)]
pub(crate) struct Options {
    /// See `cargo xtask bench --help` and bench/README.md.
    #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
    arguments: Vec<String>,
}

/// Builds and runs the bench, or that of the Python package.
pub(crate) fn run(options: Options) -> Result<(), String> {
    if let Some((first, rest)) = options.arguments.split_first()
        && first == "python"
    {
        return python_bench::run(rest);
    }
    let run = ["run", "--release", "-p", "kdray-bench", "--"];
    let arguments = run.into_iter().map(str::to_owned).chain(options.arguments).collect::<Vec<_>>();
    Steps::new().cargo_with("comparison", &arguments, &[])
}
