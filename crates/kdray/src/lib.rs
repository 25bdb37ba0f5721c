//! Exact ray queries on triangle meshes, through SAH kd-trees.
//!
//! The pipeline, in the order of the modules:
//! [`geometry`] → [`exact`] → [`primitives`] → [`tree`] → [`build`] → [`simd`] → [`layout`] →
//! [`traverse`] → [`query`].
//!
//! Most users need four names: [`TriangleMesh`], [`Scene`], [`Ray`] and [`Hit`].

#![forbid(unsafe_code)]

pub mod build;
pub mod exact;
pub mod geometry;
pub mod layout;
pub mod primitives;
pub mod query;
pub mod simd;
pub mod traverse;
pub mod tree;

pub use build::{BuildError, BuildOptions, BuildProgress, CostModel, Preset, Strategy};
pub use geometry::{Aabb, Coordinate, Interval, Ray, RayError, RayPacket};
pub use layout::Hint;
pub use primitives::{Hit, MeshError, Side, TriangleMesh};
pub use query::{Arithmetic, PacketWork, Precision, Scene, ShapeScene};
pub use simd::InstructionSet;
pub use tree::{KdTree, TreeStats};

/// The README's example, compiled and run as a test.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
pub struct ReadmeExamples;
