//! `kdray completions`: what a shell needs to complete command lines.

use crate::{
    cli::{Cli, Globals},
    error::CliError,
    output,
};
use clap::CommandFactory;
use clap_complete::Shell;

/// Print the completions of a shell
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example: completions for bash, from the next shell on
  kdray completions bash > ~/.local/share/bash-completion/completions/kdray")]
pub(crate) struct Args {
    /// The shell
    shell: Shell,
}

/// Prints the completions.
pub(crate) fn run(args: &Args, _globals: &Globals) -> Result<(), CliError> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "kdray", &mut script);
    output::print(&script)
}
