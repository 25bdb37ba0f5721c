//! How the tree is built.

use clap::ValueEnum;
use kdray::{BuildOptions, Strategy, tree::MAX_DEPTH};

/// How the tree is built.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct BuildArgs {
    /// How the splitting plane is chosen
    #[arg(long, value_name = "STRATEGY", default_value = "sah")]
    pub(crate) split: Split,
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

/// The strategies by their names on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Split {
    /// The plane of least cost by the surface area heuristic
    Sah,
    /// The middle of the box's longest side
    Middle,
    /// As many triangles left as right
    Median,
    /// The axes in turn, each cut in the middle
    RoundRobin,
}

impl Split {
    /// The library's name for it.
    pub(crate) fn strategy(self) -> Strategy {
        match self {
            Self::Sah => Strategy::Sah,
            Self::Middle => Strategy::Middle,
            Self::Median => Strategy::Median,
            Self::RoundRobin => Strategy::RoundRobin,
        }
    }

    /// Its name on the command line.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Sah => "sah",
            Self::Middle => "middle",
            Self::Median => "median",
            Self::RoundRobin => "round-robin",
        }
    }
}

impl BuildArgs {
    /// What the library is asked for.
    pub(crate) fn options(&self) -> BuildOptions {
        self.limits.options(self.split.strategy())
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

fn depth(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(depth) if depth <= MAX_DEPTH => Ok(depth),
        _ => Err(format!("give a whole number from 0 to {MAX_DEPTH}")),
    }
}
