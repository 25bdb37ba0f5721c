//! `cargo xtask parity`.

use crate::steps::{Steps, option};
use clap::Args;

/// What is counted; see `tests/src/bin/parity.rs`.
#[derive(Args)]
pub(crate) struct Options {
    /// Trace all rays; otherwise one in 101.
    #[arg(long)]
    full: bool,
    /// Only these scenes, separated by commas.
    #[arg(long)]
    scenes: Option<String>,
}

/// Runs the check.
pub(crate) fn run(options: &Options) -> Result<(), String> {
    let mut given = option("--scenes", options.scenes.as_ref());
    given.extend(options.full.then(|| "--full".to_owned()));
    Steps::on_scenes()?.check("parity of closed meshes", "parity", given)
}
