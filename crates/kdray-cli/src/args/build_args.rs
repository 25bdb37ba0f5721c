//! How the tree is built.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use kdray::{BuildOptions, Strategy, tree::MAX_DEPTH};

/// How the tree is built.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct BuildArgs {
    /// How the splitting plane is chosen
    #[arg(long, value_name = "STRATEGY", default_value = "sah", value_parser = strategies())]
    pub(crate) split: Strategy,
    #[command(flatten)]
    pub(crate) limits: LimitArgs,
}

/// Where the build stops; all that remains of [`BuildArgs`] when every strategy is built.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct LimitArgs {
    /// Do not cut nodes of this many triangles or fewer; without it 1 for sah, 8 for the others
    #[arg(long, value_name = "N")]
    pub(crate) leaf_size: Option<usize>,
    /// Do not cut deeper than this; without it 8 + 1.3 log2 of the number of triangles
    #[arg(long, value_name = "N", value_parser = depth)]
    pub(crate) max_depth: Option<usize>,
}

impl BuildArgs {
    /// What the library is asked for.
    pub(crate) fn options(&self) -> BuildOptions {
        self.limits.options(self.split)
    }
}

impl LimitArgs {
    /// What the library is asked for with the given strategy.
    pub(crate) fn options(&self, strategy: Strategy) -> BuildOptions {
        let default = BuildOptions::for_strategy(strategy);
        let leaf_size = self.leaf_size.unwrap_or(default.leaf_size);
        BuildOptions { leaf_size, max_depth: self.max_depth, ..default }
    }
}

/// The strategies by the library's names, and what the help says of each.
fn strategies() -> impl TypedValueParser<Value = Strategy> {
    let help = |strategy| match strategy {
        Strategy::Middle => "The middle of the box's longest side",
        Strategy::Median => "As many triangles left as right",
        Strategy::RoundRobin => "The axes in turn, each cut in the middle",
        Strategy::Sah => "The plane of least cost by the surface area heuristic",
    };
    let value = |strategy: Strategy| PossibleValue::new(strategy.name()).help(help(strategy));
    PossibleValuesParser::new(Strategy::ALL.map(value)).try_map(|name| name.parse())
}

fn depth(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(depth) if depth <= MAX_DEPTH => Ok(depth),
        _ => Err(format!("give a whole number from 0 to {MAX_DEPTH}")),
    }
}
