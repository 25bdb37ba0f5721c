//! `cargo xtask attack --peers`: rays are made, answered by Rust crates and Embree, answered by Python
//! packages, and judged.

use crate::steps::{Steps, say, target_folder};
use crate::venv;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The packages that are fetched from PyPI.
const PACKAGES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../bench/python/requirements.txt");

/// The program that asks them.
const PROGRAM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../bench/python/peers.py");

/// Builds and runs the four steps; `options` say how many rays there are, and which.
pub(crate) fn run(options: &[String]) -> Result<(), String> {
    let target = target_folder();
    let folder = target.join("attack").join("peers");
    let mut steps = Steps::new();
    // Both packages at once, or the library would be compiled for each of them.
    let build = "build --release -p kdray-tests -p kdray-bench --bin peers --bin kdray-bench";
    steps.cargo("programs", build, &[])?;
    let program = |name: &str| Command::new(target.join("release").join(name));
    let mut make = program("peers");
    make.arg("--write").arg(&folder).args(options);
    steps.run("meshes and rays", &mut make, "peers --write")?;
    let mut ask = program("kdray-bench");
    steps.run("crates and Embree", ask.arg("peers").arg(&folder), "kdray-bench peers")?;
    if let Err(reason) = ask_python(&mut steps, &folder) {
        say(&format!("going on without Open3D and trimesh: {reason}"));
    }
    let mut judge = program("peers");
    judge.arg("--judge").arg(&folder).args(options);
    steps.run("right or wrong", &mut judge, "peers --judge")
}

/// The Python that has the packages, in an environment of its own.
pub(crate) fn python(steps: &mut Steps) -> Result<PathBuf, String> {
    venv::python(steps, &target_folder().join("peers").join("venv"), Path::new(PACKAGES))
}

fn ask_python(steps: &mut Steps, folder: &Path) -> Result<(), String> {
    let mut ask = Command::new(python(steps)?);
    steps.run("Python packages", ask.arg(PROGRAM).arg(folder), "python bench/python/peers.py")
}
