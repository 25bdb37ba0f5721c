//! `cargo xtask agree`.

use crate::steps::{Steps, option};
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
    let rays = options.rays.map(|rays| rays.to_string());
    let given = [
        option("--scenes", options.scenes.as_ref()),
        option("--rays", rays.as_ref()),
        option("--strategies", options.strategies.as_ref()),
    ];
    Steps::on_scenes()?.check("agreement with the naive answer", "agree", given.concat())
}
