//! Exact ray queries on triangle meshes, through SAH kd-trees.
//!
//! The pipeline, in the order of the modules:
//! [`memory`] → [`geometry`] → [`exact`] → [`primitives`] → [`tree`] → [`build`] → [`simd`] → [`layout`] →
//! [`traverse`] → [`query`] → [`mod@file`].
//!
//! Most users need four names: [`TriangleMesh`], [`Scene`], [`Ray`] and [`Hit`].

#![forbid(unsafe_code)]

pub mod build;
pub mod exact;
pub mod file;
pub mod geometry;
pub mod layout;
pub mod memory;
pub mod primitives;
pub mod query;
pub mod simd;
pub mod traverse;
pub mod tree;

pub use build::{BuildError, BuildOptions, BuildProgress, CostModel, Preset, Strategy};
pub use file::FileError;
pub use geometry::{Aabb, Coordinate, Interval, Ray, RayError, RayPacket};
pub use layout::Hint;
pub use primitives::{ClosestPoint, Closure, Hit, MeshError, Side, TriangleMesh};
pub use query::{Arithmetic, Instance, InstanceHit, InstancedScene};
pub use query::{PacketWork, Precision, Scene, ShapeScene};
pub use simd::InstructionSet;
pub use tree::{KdTree, TreeStats};

/// The README's example, compiled and run as a test.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
pub struct ReadmeExamples;
