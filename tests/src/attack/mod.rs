//! Rays that are aimed to break kdray, and what is right of its answers (`cargo xtask attack`).
//!
//! The way of a round: [`targets`] are meshes, closed ones and awkward ones, in f32 and in f64; [`aim`] makes volleys of
//! rays at one of them, [`answers`] asks every kernel and query of kdray about a [`volley`], [`mod@truth`] finds the
//! hits without kdray's help, and [`verdict`] counts what is wrong. What is, is made as small as possible
//! and told as a test ([`case`]). [`trees`] compares the bytes of trees, [`points`] asks about points, [`saved`] reads
//! tree files, whole and damaged ones, and [`placed`] shoots at copies. [`campaign`] runs it all and [`report`] tells it.

pub mod aim;
pub mod answers;
mod attacked;
pub mod campaign;
pub mod case;
mod extent;
mod other_queries;
pub mod placed;
pub mod points;
pub mod points_truth;
pub mod report;
pub mod saved;
pub mod settings;
pub mod tally;
mod target;
pub mod targets;
pub mod trees;
pub mod truth;
pub mod verdict;
pub mod volley;

/// Targets of more triangles are not asked all that takes long for each triangle.
const FEW: usize = 2000;

pub use attacked::Attacked;
pub use campaign::{Campaign, Limits};
pub use case::{Case, assert_right};
pub use extent::Extent;
pub use tally::Tally;
pub use target::{AnyTarget, Target};
pub use truth::Truth;
pub use volley::Volley;
