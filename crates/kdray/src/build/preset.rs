//! Settings for a purpose, and their names.

use super::{BuildOptions, CostModel, SahBuilder, Strategy};
use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// Settings for a purpose: trees by the surface area heuristic for leaves whose primitives are
/// tested eight at once, pruned.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Preset {
    /// The shortest build: bounds are counted in bins at all nodes, and nodes of three blocks are left
    /// uncut.
    Fast,
    /// A build a little longer, of a tree that is nearly the best and a little smaller: bins above,
    /// and all candidates at small nodes.
    #[default]
    Balanced,
    /// The least expected cost: all candidates at all nodes, and nodes cut as far as it pays. The
    /// tree is larger, and the build takes several times as long.
    Best,
}

/// A name that no preset has.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("no preset is called {0:?}; give fast, balanced or best")]
pub struct UnknownPreset(pub String);

impl Preset {
    /// All of them, by the time that a build takes.
    pub const ALL: [Self; 3] = [Self::Fast, Self::Balanced, Self::Best];

    /// The name that it has on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fast => "fast",
            Self::Balanced => "balanced",
            Self::Best => "best",
        }
    }

    /// The settings. To leave nodes of three blocks uncut saves a third of the build, and rays take
    /// a sixth longer; [`Best`](Self::Best) weighs cuts within a block, too.
    pub(super) fn options(self) -> BuildOptions {
        let (sah_builder, leaf_size) = match self {
            Self::Fast => (SahBuilder::Binned { sweep_below: 0 }, 24),
            Self::Balanced => (SahBuilder::Binned { sweep_below: 64 }, 8),
            Self::Best => (SahBuilder::Sweep, 4),
        };
        let settings = BuildOptions::for_strategy(Strategy::Sah);
        BuildOptions {
            cost: CostModel::BLOCKS_OF_8,
            sah_builder,
            leaf_size,
            prune: true,
            ..settings
        }
    }
}

impl fmt::Display for Preset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Preset {
    type Err = UnknownPreset;

    fn from_str(name: &str) -> Result<Self, UnknownPreset> {
        let named = |preset: &Self| preset.name() == name;
        Self::ALL.into_iter().find(named).ok_or_else(|| UnknownPreset(name.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_written() {
        for preset in Preset::ALL {
            assert_eq!(preset.to_string().parse(), Ok(preset));
        }
        assert_eq!("Best".parse::<Preset>(), Err(UnknownPreset("Best".to_owned())));
    }
}
