//! From primitives to a tree: the steps of the founding lecture (S6), written once.
//!
//! The steps ask a strategy for one thing only, the plane: [`Strategy::Middle`],
//! [`Strategy::Median`] and [`Strategy::RoundRobin`] find it by a rule, [`Strategy::Sah`] by least
//! cost under a [`CostModel`], from candidates that [`SahBuilder`] says how to count.
//!
//! The tree is the same bit for bit on every run and for any number of threads. What a build may
//! take is bounded: leaves list at most [`BuildOptions::reference_quota`] entries together.

mod distribute;
mod error;
mod median;
mod middle;
mod options;
mod parallel;
mod plane;
mod progress;
mod reference;
mod round_robin;
mod sah;
mod steps;
mod strategy;
mod subtree;

pub use crate::tree::{CostModel, CostModelError, Termination};
pub use error::BuildError;
pub use options::{BuildOptions, SahBuilder};
pub use progress::BuildProgress;
pub use strategy::{Strategy, UnknownStrategy};

use crate::geometry::Aabb;
use crate::primitives::Primitives;
use crate::tree::KdTree;
use progress::Progress;
use std::ops::ControlFlow;
use steps::Build;

impl<const K: usize> KdTree<K> {
    /// Builds the tree over `primitives`. K is 1, 2 or 3.
    ///
    /// Without primitives the tree is one empty leaf. A primitive whose bounds are empty
    /// (`min > max`, but finite) is nowhere, and no leaf lists it.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build(
        primitives: &impl Primitives<K>,
        options: &BuildOptions,
    ) -> Result<Self, BuildError> {
        Self::build_with_progress(primitives, options, &|_| ControlFlow::Continue(()))
    }

    /// Builds the tree, and tells `progress` now and then how far it is, from any thread, one call
    /// at a time; [`ControlFlow::Break`] stops the build.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build_with_progress(
        primitives: &impl Primitives<K>,
        options: &BuildOptions,
        progress: &(dyn Fn(BuildProgress) -> ControlFlow<()> + Sync),
    ) -> Result<Self, BuildError> {
        Ok(Self::build_all(primitives, options, progress, false)?.0)
    }

    /// Builds the tree, and, if `keep_bounds` says so, the bounds of the part of each of its
    /// references in its leaf.
    fn build_all(
        primitives: &impl Primitives<K>,
        options: &BuildOptions,
        progress: &(dyn Fn(BuildProgress) -> ControlFlow<()> + Sync),
        keep_bounds: bool,
    ) -> Result<(Self, Vec<Aabb<K>>), BuildError> {
        const { assert!(K >= 1 && K <= 3, "a node has room for three axes") };
        let progress = &Progress::new(progress);
        let cost = options.cost;
        cost.check()?;
        macro_rules! build {
            ($strategy:expr) => {
                Build { primitives, strategy: &$strategy, options, progress, keep_bounds }.run()
            };
        }
        match (options.strategy, options.sah_builder) {
            (Strategy::Middle, _) => build!(middle::Middle),
            (Strategy::Median, _) => build!(median::Median),
            (Strategy::RoundRobin, _) => build!(round_robin::RoundRobin),
            (Strategy::Sah, SahBuilder::Sweep) => build!(sah::Sweep { cost }),
            (Strategy::Sah, SahBuilder::Naive) => build!(sah::Naive { cost }),
            (Strategy::Sah, SahBuilder::Binned { sweep_below }) => {
                build!(sah::Binned { cost, sweep_below })
            }
        }
    }
}
