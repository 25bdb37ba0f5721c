//! What fuzzing runs: bytes in, and a panic if kdray does what it must not.
//!
//! The bodies are here, so that the programs in `fuzz/` (coverage, mutation, an address sanitizer) and the test
//! `tests/fuzz.rs` (which runs what they found worth keeping) run the same code. [`draw`] turns bytes into numbers,
//! meshes, rays and options; [`seeds`] are inputs made by code to begin with.

pub mod build_and_query;
pub mod draw;
pub mod instances;
pub mod loaders;
pub mod points;
pub mod seeds;
pub mod tree_file;

use kdray_scene::Format;

/// Something to fuzz.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// What its program and its corpus are called.
    pub name: &'static str,
    /// Runs one input; a panic is a bug.
    pub body: fn(&[u8]),
    /// How many bytes are worth trying.
    pub max_len: usize,
    /// Inputs to begin with.
    pub seeds: fn() -> Vec<Vec<u8>>,
}

/// All of them.
pub const TARGETS: [Target; 12] = [
    Target { name: "obj", body: loaders::obj, max_len: 2048, seeds: seeds::obj },
    Target {
        name: "ply",
        body: |d| loaders::read(Format::Ply, d),
        max_len: 1024,
        seeds: seeds::ply,
    },
    Target {
        name: "stl",
        body: |d| loaders::read(Format::Stl, d),
        max_len: 1024,
        seeds: seeds::stl,
    },
    Target {
        name: "off",
        body: |d| loaders::read(Format::Off, d),
        max_len: 512,
        seeds: seeds::off,
    },
    Target {
        name: "gltf",
        body: |d| loaders::read(Format::Gltf, d),
        max_len: 4096,
        seeds: seeds::gltf,
    },
    Target { name: "glb", body: loaders::glb, max_len: 4096, seeds: seeds::glb },
    Target {
        name: "compressed",
        body: loaders::compressed,
        max_len: 1024,
        seeds: seeds::compressed,
    },
    Target { name: "tree_file", body: tree_file::run, max_len: 8192, seeds: seeds::tree_file },
    Target {
        name: "build_and_query_f32",
        body: build_and_query::f32,
        max_len: 512,
        seeds: seeds::any,
    },
    Target {
        name: "build_and_query_f64",
        body: build_and_query::f64,
        max_len: 512,
        seeds: seeds::any,
    },
    Target { name: "points", body: points::run, max_len: 512, seeds: seeds::any },
    Target { name: "instances", body: instances::run, max_len: 512, seeds: seeds::any },
];

/// Runs an input of a target.
///
/// # Panics
/// If there is no such target, or kdray fails.
pub fn run(name: &str, data: &[u8]) {
    let target = TARGETS.iter().find(|target| target.name == name);
    (target.expect("a target of this name").body)(data);
}
