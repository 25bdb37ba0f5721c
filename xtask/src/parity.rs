//! `cargo xtask parity`.

use crate::steps::{Steps, need_scenes};
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
    need_scenes()?;
    let mut arguments: Vec<String> = "run --release --quiet -p kdray-tests --bin parity --"
        .split(' ')
        .map(str::to_owned)
        .collect();
    arguments.extend(options.full.then(|| "--full".to_owned()));
    arguments.extend(options.scenes.iter().flat_map(|s| ["--scenes".to_owned(), s.clone()]));
    Steps::new().cargo_with("parity of closed meshes", &arguments, &[])
}
