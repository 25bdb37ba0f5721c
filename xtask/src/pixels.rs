//! `cargo xtask pixels`.

use crate::steps::{Steps, option};
use clap::Args;

/// What is rendered; see `tests/src/bin/pixels.rs`.
#[derive(Args)]
pub(crate) struct Options {
    /// Only these scenes, separated by commas; five large ones if not given.
    #[arg(long)]
    scenes: Option<String>,
}

/// Runs the comparison.
pub(crate) fn run(options: &Options) -> Result<(), String> {
    let mut steps = Steps::on_scenes()?;
    steps.cargo("the command", "build --release --quiet -p kdray-cli", &[])?;
    let given = option("--scenes", options.scenes.as_ref());
    steps.check("pictures by every strategy", "pixels", given)
}
