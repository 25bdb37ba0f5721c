//! `cargo xtask bench python`: the Python package beside trimesh and Open3D, and beside the Rust library.

use crate::package;
use crate::peers;
use crate::steps::{Steps, target_folder};
use std::process::Command;

/// The program that measures.
const PROGRAM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../bench/python/bench.py");

/// Builds the package and the bench, and runs the program; it has help of its own.
pub(crate) fn run(options: &[String]) -> Result<(), String> {
    let mut steps = Steps::new();
    let python = peers::python(&mut steps)?;
    // Both at once, or the library would be compiled for each of them.
    let build = "build --release -p kdray-bench --bin kdray-bench -p kdray-python --lib";
    steps.cargo("programs", build, &[])?;
    let home = target_folder().join("bench").join("python");
    let package = home.join("package");
    package::assemble(&package, "release")?;
    let native = target_folder().join("release").join("kdray-bench");
    let mut bench = Command::new(python);
    bench.arg(PROGRAM).arg("--native").arg(native).arg("--work").arg(home.join("cases"));
    bench.args(options).env("PYTHONPATH", &package);
    let line = format!("python bench/python/bench.py {}", options.join(" "));
    steps.run("kdray, trimesh, Open3D", &mut bench, line.trim_end())
}
