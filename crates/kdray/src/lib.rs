//! Exact ray queries on triangle meshes, through SAH kd-trees.
//!
//! The pipeline, in the order of the modules:
//! [`memory`] → [`geometry`] → [`exact`] → [`primitives`] → [`tree`] → [`build`] → [`simd`] → [`layout`] →
//! [`traverse`] → [`query`] → [`mod@file`].
//!
//! Most users need four names: [`TriangleMesh`], [`Scene`], [`Ray`] and [`Hit`]. Of a [`Scene`] can be asked:
//!
//! | what | by |
//! |---|---|
//! | what a ray hits first, and whether anything | [`closest_hit`](Scene::closest_hit), [`any_hit`](Scene::any_hit) |
//! | the same of hits that a condition holds for | [`closest_hit_where`](Scene::closest_hit_where), [`any_hit_where`](Scene::any_hit_where) |
//! | the same of many rays | [`closest_hits`](Scene::closest_hits), [`par_closest_hits`](Scene::par_closest_hits), [`each_closest_hit`](Scene::each_closest_hit), and so for `any_hit` |
//! | of rays that share an origin, a direction or a target | [`packet_closest_hits`](Scene::packet_closest_hits), [`packet_any_hits`](Scene::packet_any_hits) |
//! | of rays that begin at a hit | [`any_hit_near`](Scene::any_hit_near), [`any_hits_near`](Scene::any_hits_near) |
//! | all crossings, in order, one by one or at once; those after a hit | [`all_hits`](Scene::all_hits), [`all_hits_into`](Scene::all_hits_into); [`all_hits_after`](Scene::all_hits_after) |
//! | how many they are | [`count`](Scene::count), [`counts`](Scene::counts) |
//! | whether a point is inside; how far the surface is, and where | [`contains`](Scene::contains); [`signed_distance`](Scene::signed_distance), [`closest_point`](Scene::closest_point) |
//! | whether two points see each other; how thick a wall is | [`visible`](Scene::visible), [`thickness`](Scene::thickness) |
//!
//! What a build may take: [`BuildOptions::peak_bytes`], [`BuildOptions::memory_limit`]; to watch or end it:
//! [`Scene::build_with_progress`].

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
