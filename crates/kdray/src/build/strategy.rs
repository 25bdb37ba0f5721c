//! The four ways to choose the splitting plane, and their names.

use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// How the splitting plane is chosen (S7 to S10).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Strategy {
    /// The middle of the box's longest side.
    Middle,
    /// The median, on the longest side, of the middles of the primitives' bounds, as clipped to the
    /// box: as many left as right.
    Median,
    /// The axes in turn, X → Y → Z → X, each cut in the middle of the box.
    RoundRobin,
    /// The plane of least cost by the surface area heuristic.
    #[default]
    Sah,
}

/// A name that no strategy has.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("no strategy is called {0:?}; give middle, median, round-robin or sah")]
pub struct UnknownStrategy(pub String);

impl Strategy {
    /// All of them, in the lecture's order.
    pub const ALL: [Self; 4] = [Self::Middle, Self::Median, Self::RoundRobin, Self::Sah];

    /// The name that it has on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Middle => "middle",
            Self::Median => "median",
            Self::RoundRobin => "round-robin",
            Self::Sah => "sah",
        }
    }
}

impl fmt::Display for Strategy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Strategy {
    type Err = UnknownStrategy;

    fn from_str(name: &str) -> Result<Self, UnknownStrategy> {
        let named = |strategy: &Self| strategy.name() == name;
        Self::ALL.into_iter().find(named).ok_or_else(|| UnknownStrategy(name.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_written() {
        for strategy in Strategy::ALL {
            assert_eq!(strategy.to_string().parse(), Ok(strategy));
        }
        assert_eq!("Sah".parse::<Strategy>(), Err(UnknownStrategy("Sah".to_owned())));
    }
}
