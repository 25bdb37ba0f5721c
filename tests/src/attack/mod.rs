//! Rays that are aimed to break kdray, and what is right of its answers (`cargo xtask attack`).
//!
//! The way of a round: [`targets`] are meshes, closed ones and awkward ones; [`aim`] makes volleys of rays
//! at one of them, [`answers`] asks every kernel and query of kdray about a [`volley`], [`mod@truth`] finds the
//! hits without kdray's help, and [`verdict`] counts what is wrong. What is, is made as small as possible
//! and told as a test ([`case`]). [`trees`] compares the bytes of trees. [`campaign`] runs it all and
//! [`report`] tells it.
//!
//! Meshes in f64, and queries such as whether a point is inside, belong here when they come: as targets in
//! [`targets`], as members of [`answers::Walked`] that [`verdict`] judges, and as counts of [`Tally`], which are the
//! columns of [`report`].

pub mod aim;
pub mod answers;
pub mod campaign;
pub mod case;
pub mod report;
pub mod settings;
pub mod tally;
pub mod targets;
pub mod trees;
pub mod truth;
pub mod verdict;
pub mod volley;

pub use campaign::{Campaign, Limits};
pub use case::{Case, assert_right};
pub use tally::Tally;
pub use targets::Target;
pub use truth::Truth;
pub use volley::Volley;
