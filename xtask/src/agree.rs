//! `cargo xtask agree`.

use crate::steps::{Steps, need_scenes};
use clap::Args;

/// What is compared; see `tests/src/bin/agree.rs`.
#[derive(Args)]
pub(crate) struct Options {
    /// Only these scenes, separated by commas; all of scenes.json if not given.
    #[arg(long)]
    scenes: Option<String>,
    /// This many random rays a scene, instead of a 512 x 512 view for scenes under 100,000
    /// triangles and 100,000 random rays for larger ones.
    #[arg(long)]
    rays: Option<usize>,
    /// Only these strategies, separated by commas: middle, median, round-robin, sah.
    #[arg(long)]
    strategies: Option<String>,
}

/// Runs the comparison.
pub(crate) fn run(options: &Options) -> Result<(), String> {
    need_scenes()?;
    let mut arguments: Vec<String> = "run --release --quiet -p kdray-tests --bin agree --"
        .split(' ')
        .map(str::to_owned)
        .collect();
    let rays = options.rays.map(|rays| rays.to_string());
    let given =
        [("--scenes", &options.scenes), ("--rays", &rays), ("--strategies", &options.strategies)];
    for (name, value) in given {
        arguments.extend(value.iter().flat_map(|value| [name.to_owned(), value.clone()]));
    }
    Steps::new().cargo_with("agreement with the naive answer", &arguments, &[])
}
