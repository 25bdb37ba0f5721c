//! How trees under attack are built.

use super::FEW;
use kdray::{BuildOptions, CostModel, Preset, Strategy};

/// The names of all settings: each strategy with leaves of one triangle, where it can, each preset, and one leaf for all.
pub const NAMES: [&str; 8] =
    ["sah", "balanced", "middle", "fast", "median", "best", "round-robin", ONE_LEAF];
const ONE_LEAF: &str = "one leaf";

/// Those that are tried with so many triangles: too many in one leaf take too long.
pub fn names(triangles: usize) -> &'static [&'static str] {
    if triangles <= FEW { &NAMES } else { &NAMES[..NAMES.len() - 1] }
}

/// The settings of a name; all give wide trees, but of sizes that these do not reach. Those of the default for a name that nothing has.
pub fn named(name: &str) -> BuildOptions {
    let blocks = |options: BuildOptions| BuildOptions {
        leaf_size: 1,
        cost: CostModel { block: 8, ..options.cost },
        ..options
    };
    let strategy = Strategy::ALL.into_iter().find(|strategy| strategy.name() == name);
    let preset = name.parse::<Preset>().unwrap_or_default();
    if name == ONE_LEAF {
        return BuildOptions { leaf_size: usize::MAX, ..BuildOptions::default() };
    }
    let of_strategy = strategy.map(|strategy| blocks(BuildOptions::for_strategy(strategy)));
    of_strategy.unwrap_or_else(|| BuildOptions::preset(preset))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_has_settings_of_its_own() {
        let all = NAMES.map(named);
        for (i, options) in all.iter().enumerate() {
            assert!(all[..i].iter().all(|other| other != options), "{}", NAMES[i]);
            assert_eq!(options.cost.block, 8);
        }
    }
}
