//! What fuzzing runs: bytes in, and a panic if kdray does what it must not.
//!
//! The bodies are here, so that the programs in `fuzz/` (coverage, mutation, an address sanitizer) and the test
//! `tests/fuzz.rs` (which runs what they found worth keeping) run the same code. [`draw`] turns bytes into numbers,
//! meshes, rays and options; [`seeds`] are inputs made by code to begin with.

pub mod build_and_query;
pub mod draw;
mod exact_points;
pub mod instances;
pub mod loaders;
pub mod points;
mod refusals;
pub mod seeds;
pub mod tree_file;

use kdray::InstructionSet;
use kdray_scene::Format;
use std::fs;
use std::path::PathBuf;

/// Something to fuzz.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// What its program and its corpus are called.
    pub name: &'static str,
    /// Runs one input; a panic is a bug.
    pub body: fn(&[u8]),
    /// Inputs to begin with.
    pub seeds: fn() -> Vec<Vec<u8>>,
}

impl Target {
    const fn new(name: &'static str, body: fn(&[u8]), seeds: fn() -> Vec<Vec<u8>>) -> Self {
        Self { name, body, seeds }
    }
}

/// All of them.
pub const TARGETS: [Target; 12] = [
    Target::new("obj", loaders::obj, seeds::obj),
    Target::new("ply", |data| loaders::read(Format::Ply, data), seeds::ply),
    Target::new("stl", |data| loaders::read(Format::Stl, data), seeds::stl),
    Target::new("off", |data| loaders::read(Format::Off, data), seeds::off),
    Target::new("gltf", |data| loaders::read(Format::Gltf, data), seeds::gltf),
    Target::new("glb", loaders::glb, seeds::glb),
    Target::new("compressed", loaders::compressed, seeds::compressed),
    Target::new("tree_file", tree_file::run, seeds::tree_file),
    Target::new("build_and_query_f32", build_and_query::f32, seeds::any),
    Target::new("build_and_query_f64", build_and_query::f64, seeds::any),
    Target::new("points", points::run, seeds::any),
    Target::new("instances", instances::run, seeds::any),
];

/// Which instruction set an input is run by: its length says so, for which no byte has to be read.
fn instructions(data: &[u8]) -> InstructionSet {
    let sets = InstructionSet::available();
    sets[data.len() % sets.len()]
}

fn target(name: &str) -> &'static Target {
    let target = TARGETS.iter().find(|target| target.name == name);
    target.expect("a target of this name")
}

/// Runs an input of a target.
///
/// # Panics
/// If there is no such target, or kdray fails.
pub fn run(name: &str, data: &[u8]) {
    (target(name).body)(data);
}

/// Writes the inputs that a target begins with to the folder that `KDRAY_SEEDS` names, if it does.
///
/// # Panics
/// If there is no such target, or the folder cannot be written.
pub fn write_seeds(name: &str) {
    let Some(folder) = std::env::var_os("KDRAY_SEEDS").map(PathBuf::from) else { return };
    for (index, seed) in (target(name).seeds)().iter().enumerate() {
        let written = fs::write(folder.join(format!("seed-{index}")), seed);
        written.unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    }
}
