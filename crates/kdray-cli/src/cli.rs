//! What the command line may say.

use crate::{commands, error::CliError, interrupt};
use clap::{Args, Parser, Subcommand};

const EXIT_CODES: &str = "\
Exit codes:
    0  done
    1  an answer is wrong: `validate` found a broken tree, or `compare` different hits
    2  the command line is at fault
    3  an input could not be read, or was refused
    4  an output could not be written
  130  interrupted by Ctrl-C; `render` has then written what was done

Example: render the built-in scene to kdray.png
  kdray render";

/// Ray queries on triangle meshes, through kd-trees that you can see.
#[derive(Debug, Parser)]
#[command(name = "kdray", version, propagate_version = true, after_help = EXIT_CODES)]
pub(crate) struct Cli {
    #[command(flatten)]
    globals: Globals,
    #[command(subcommand)]
    command: Command,
}

/// What every command understands.
#[derive(Debug, Args)]
pub(crate) struct Globals {
    /// Work on this many threads; all cores without it. The results are the same
    #[arg(long, global = true, display_order = 900, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) threads: Option<u16>,
    /// Say nothing on standard error but errors
    #[arg(long, short, global = true, display_order = 901)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Subcommand)]
enum Command {
    Render(Box<commands::render::Args>),
    Merge(commands::merge::Args),
    Build(commands::build::Args),
    Stats(commands::stats::Args),
    Validate(commands::validate::Args),
    Compare(commands::compare::Args),
    Trace(commands::trace::Args),
    Draw(commands::draw::Args),
    Query(commands::query::Args),
    Completions(commands::completions::Args),
    Man(commands::man::Args),
}

/// Reads the command line and does what it says.
pub(crate) fn run() -> Result<(), CliError> {
    let Cli { globals, command } = Cli::parse();
    interrupt::listen();
    if let Some(threads) = globals.threads {
        // The global pool, so that every crate below uses it.
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads.into())
            .build_global()
            .map_err(|error| CliError::Usage(format!("--threads {threads}: {error}")))?;
    }
    match &command {
        Command::Render(args) => commands::render::run(args, &globals),
        Command::Merge(args) => commands::merge::run(args, &globals),
        Command::Build(args) => commands::build::run(args, &globals),
        Command::Stats(args) => commands::stats::run(args, &globals),
        Command::Validate(args) => commands::validate::run(args, &globals),
        Command::Compare(args) => commands::compare::run(args, &globals),
        Command::Trace(args) => commands::trace::run(args, &globals),
        Command::Draw(args) => commands::draw::run(args, &globals),
        Command::Query(args) => commands::query::run(args, &globals),
        Command::Completions(args) => commands::completions::run(args, &globals),
        Command::Man(args) => commands::man::run(args, &globals),
    }
}
