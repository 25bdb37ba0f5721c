//! How the tree is built.

use super::MemoryLimit;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use kdray::{BuildOptions, Strategy, build::Preset, tree::MAX_DEPTH};

/// How the tree is built that answers: for the fast kernels, or by a strategy of the lecture.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct FastBuildArgs {
    /// How long the build may take for how fast a tree; balanced if --split is not given either
    #[arg(long, value_name = "PRESET", value_parser = presets(), conflicts_with = "split")]
    pub(crate) preset: Option<Preset>,
    /// Take the lecture's tree by this way to choose the splitting plane, and its traversal
    #[arg(long, value_name = "STRATEGY", value_parser = strategies())]
    pub(crate) split: Option<Strategy>,
    #[command(flatten)]
    pub(crate) limits: LimitArgs,
}

/// How the tree is built that is looked at.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct BuildArgs {
    /// How the splitting plane is chosen; sah without it
    #[arg(long, value_name = "STRATEGY", value_parser = strategies())]
    pub(crate) split: Option<Strategy>,
    #[command(flatten)]
    pub(crate) limits: LimitArgs,
}

/// Where the build stops; all that remains of [`BuildArgs`] when every strategy is built.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct LimitArgs {
    /// Do not cut nodes of this many triangles or fewer; without it 1 for sah, 8 for the other
    /// strategies, 24 or fewer for presets
    #[arg(long, value_name = "N")]
    pub(crate) leaf_size: Option<usize>,
    /// Do not cut deeper than this; without it 8 + 1.3 log2 of the number of triangles
    #[arg(long, value_name = "N", value_parser = depth)]
    pub(crate) max_depth: Option<usize>,
    /// Refuse to build a tree that is expected to take more memory than this, such as 8GiB or
    /// 500MB; `none` for no limit; without it what is available
    #[arg(long, value_name = "SIZE")]
    pub(crate) memory_limit: Option<MemoryLimit>,
}

impl FastBuildArgs {
    /// What the library is asked for.
    pub(crate) fn options(&self) -> BuildOptions {
        let preset = BuildOptions::preset(self.preset.unwrap_or_default());
        self.limits.apply(self.split.map_or(preset, BuildOptions::for_strategy))
    }

    /// The options that were given, by their names: what has no meaning for a tree that is there.
    pub(crate) fn given(&self) -> impl Iterator<Item = &'static str> {
        let own = [("--preset", self.preset.is_some()), ("--split", self.split.is_some())];
        own.into_iter()
            .filter_map(|(name, is_given)| is_given.then_some(name))
            .chain(self.limits.given())
    }

    /// The same with a tree of the lecture, by default that of the surface area heuristic.
    pub(crate) fn lecture_options(&self) -> BuildOptions {
        self.limits.options(self.split.unwrap_or_default())
    }
}

impl BuildArgs {
    /// What the library is asked for.
    pub(crate) fn options(&self) -> BuildOptions {
        self.limits.options(self.strategy())
    }

    /// How the splitting plane is chosen.
    pub(crate) fn strategy(&self) -> Strategy {
        self.split.unwrap_or_default()
    }
}

impl LimitArgs {
    /// The options that were given, by their names, but for the limit of memory.
    pub(crate) fn given(&self) -> impl Iterator<Item = &'static str> {
        let own =
            [("--leaf-size", self.leaf_size.is_some()), ("--max-depth", self.max_depth.is_some())];
        own.into_iter().filter_map(|(name, is_given)| is_given.then_some(name))
    }

    /// What the library is asked for with the given strategy.
    pub(crate) fn options(&self, strategy: Strategy) -> BuildOptions {
        self.apply(BuildOptions::for_strategy(strategy))
    }

    fn apply(&self, options: BuildOptions) -> BuildOptions {
        let leaf_size = self.leaf_size.unwrap_or(options.leaf_size);
        let memory_limit = self.memory_limit.unwrap_or_default().bytes();
        BuildOptions { leaf_size, max_depth: self.max_depth, memory_limit, ..options }
    }
}

/// The presets by the library's names, and what the help says of each.
fn presets() -> impl TypedValueParser<Value = Preset> {
    let help = |preset| match preset {
        Preset::Fast => "The shortest build",
        Preset::Balanced => "A build a little longer, of a tree that is nearly the best",
        Preset::Best => "The fastest tree; the build takes three times as long",
    };
    let value = |preset: Preset| PossibleValue::new(preset.name()).help(help(preset));
    PossibleValuesParser::new(Preset::ALL.map(value)).try_map(|name| name.parse())
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
