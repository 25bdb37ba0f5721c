//! `cargo xtask attack --peers`: rays are made, answered by Rust crates and Embree, answered by Python
//! packages, and judged.

use crate::steps::{Steps, say, target_folder};
use std::path::Path;
use std::process::Command;

/// What is fetched from PyPI: the peers as the figures in the README were taken with, and what Open3D needs of
/// the system.
const PACKAGES: [&str; 4] =
    ["open3d-cpu==0.20.0", "trimesh==5.2.0", "embreex==4.4.0.post1", "libusb-package==1.0.30.0"];

/// The program that asks them.
const PROGRAM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../bench/peers.py");

/// Builds and runs the four steps; `options` say how many rays there are, and which.
pub(crate) fn run(options: &[String]) -> Result<(), String> {
    let target = target_folder();
    let (home, folder) = (target.join("attack"), target.join("attack").join("peers"));
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
    if let Err(reason) = ask_python(&mut steps, &home.join("venv"), &folder) {
        say(&format!("going on without Open3D and trimesh: {reason}"));
    }
    let mut judge = program("peers");
    judge.arg("--judge").arg(&folder).args(options);
    steps.run("right or wrong", &mut judge, "peers --judge")
}

/// Makes a virtual environment with the packages, if that was not done yet, and runs the program in it.
fn ask_python(steps: &mut Steps, venv: &Path, folder: &Path) -> Result<(), String> {
    let python = venv.join("bin").join("python");
    let mark = venv.join(PACKAGES.join(" "));
    if !mark.exists() {
        let mut make = Command::new("python3");
        make.args(["-m", "venv", "--clear"]).arg(venv);
        steps.run("environment", &mut make, "python3 -m venv")?;
        let mut fetch = Command::new(&python);
        fetch.args(["-m", "pip", "install", "--quiet", "--only-binary=:all:"]).args(PACKAGES);
        let line = format!("pip install {}", PACKAGES.join(" "));
        steps.run("Python packages, once", &mut fetch, &line)?;
        std::fs::write(&mark, "").map_err(|error| error.to_string())?;
    }
    let mut ask = Command::new(&python);
    steps.run("Python packages", ask.arg(PROGRAM).arg(folder), "python bench/peers.py")
}
