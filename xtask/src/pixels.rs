//! `cargo xtask pixels`.

use crate::steps::{Steps, need_scenes};
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
    need_scenes()?;
    let mut arguments: Vec<String> = "run --release --quiet -p kdray-tests --bin pixels --"
        .split(' ')
        .map(str::to_owned)
        .collect();
    arguments.extend(options.scenes.iter().flat_map(|s| ["--scenes".to_owned(), s.clone()]));
    let mut steps = Steps::new();
    steps.cargo("the command", "build --release --quiet -p kdray-cli", &[])?;
    steps.cargo_with("pictures by every strategy", &arguments, &[])
}
