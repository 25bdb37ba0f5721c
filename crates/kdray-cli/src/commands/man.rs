//! `kdray man`: manual pages.

use crate::{
    cli::{Cli, Globals},
    error::CliError,
    output::{self, Output},
};
use clap::CommandFactory;
use clap_mangen::Man;
use std::path::{Path, PathBuf};

/// Print the manual page, or write one page a command
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example: read the manual page
  kdray man | man -l -

Example: write kdray.1, kdray-render.1 and the others
  kdray man --out ~/.local/share/man/man1")]
pub(crate) struct Args {
    /// Write kdray.1 and a page for each command into this folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Prints or writes the pages.
pub(crate) fn run(args: &Args, _globals: &Globals) -> Result<(), CliError> {
    let mut command = Cli::command();
    command.build();
    match &args.out {
        None => output::print(&page(command)?),
        Some(folder) => write_pages(command, folder),
    }
}

fn page(command: clap::Command) -> Result<Vec<u8>, CliError> {
    let mut text = Vec::new();
    Man::new(command).render(&mut text).map_err(CliError::Stdout)?;
    Ok(text)
}

fn write_pages(command: clap::Command, folder: &Path) -> Result<(), CliError> {
    std::fs::create_dir_all(folder).map_err(|error| CliError::output(folder, error))?;
    for each in command.get_subcommands().filter(|each| each.get_name() != "help") {
        let path = folder.join(format!("kdray-{}.1", each.get_name()));
        Output::write(&path, &page(each.clone())?)?;
    }
    Output::write(&folder.join("kdray.1"), &page(command)?)
}
