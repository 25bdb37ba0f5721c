//! The commands, one a module: what it takes (`Args`) and what it does (`run`).

pub(crate) mod build;
pub(crate) mod compare;
pub(crate) mod completions;
pub(crate) mod draw;
pub(crate) mod man;
pub(crate) mod merge;
pub(crate) mod query;
pub(crate) mod render;
pub(crate) mod stats;
pub(crate) mod trace;
pub(crate) mod validate;
