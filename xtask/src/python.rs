//! The Python package: its tests, and whether its types are what they are said to be.

use crate::steps::{Steps, target_folder};
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The package's crate.
const CRATE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../crates/kdray-python");

/// The compiled part by its name in the package, which every Python from 3.9 on finds.
const MODULE: &str = if cfg!(windows) { "_kdray.pyd" } else { "_kdray.abi3.so" };

/// Tests the package in a virtual environment, with what `cargo test` compiled: a wheel, of a release build and
/// other features, would have to be compiled anew.
pub(crate) fn run(steps: &mut Steps) -> Result<(), String> {
    let home = target_folder().join("python");
    let packages = Path::new(CRATE).join("tests/requirements.txt");
    let python = environment(steps, &home.join("venv"), &packages)?;
    // What the tests before compiled, but for its name.
    steps.cargo("Python, compiled part", "build --workspace --all-targets", &[])?;
    let package = assemble(&home.join("package"))?;
    let mut run = |what: &str, arguments: &[&str]| {
        let mut command = Command::new(&python);
        command.args(arguments).current_dir(CRATE);
        command.env("PYTHONPATH", &package).env("PYTHONDONTWRITEBYTECODE", "1");
        steps.run(what, &mut command, &format!("python {}", arguments.join(" ")))
    };
    run("Python, tests", &["-m", "pytest", "--quiet", "-p", "no:cacheprovider"])?;
    run("Python, types", &["-m", "mypy", "--cache-dir", mypy_cache(&home)?.as_str()])?;
    let stubs = ["-m", "mypy.stubtest", "--mypy-config-file", "pyproject.toml", "kdray"];
    run("Python, types of the compiled part", &stubs)
}

/// Makes a virtual environment with the packages that a list names, if that was not done yet. The Python in it.
fn environment(steps: &mut Steps, venv: &Path, packages: &Path) -> Result<PathBuf, String> {
    let python = venv.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let wanted = fs::read(packages).map_err(|error| told(packages, &error))?;
    let mark = venv.join("requirements.txt");
    if fs::read(&mark).is_ok_and(|made_with| made_with == wanted) {
        return Ok(python);
    }
    let mut make = Command::new("python3");
    make.args(["-m", "venv", "--clear"]).arg(venv);
    steps.run("Python, environment", &mut make, "python3 -m venv").map_err(|reason| {
        format!("{reason}; the tests of the package need Python 3.11 or newer, with venv (on Debian: apt install python3-venv)")
    })?;
    let mut fetch = Command::new(&python);
    fetch.args(["-m", "pip", "install", "--quiet", "--only-binary=:all:", "-r"]).arg(packages);
    let line = "pip install -r crates/kdray-python/tests/requirements.txt";
    steps.run("Python, what the tests need", &mut fetch, line)?;
    fs::write(&mark, wanted).map_err(|error| told(&mark, &error))?;
    Ok(python)
}

/// Puts the package together in `folder`, which is to be on Python's path.
fn assemble(folder: &Path) -> Result<PathBuf, String> {
    let (source, package) = (Path::new(CRATE).join("python/kdray"), folder.join("kdray"));
    // What is not there any more shall not be found.
    let _ = fs::remove_dir_all(&package);
    copy_all(&source, &package)?;
    let prefix = std::env::consts::DLL_PREFIX;
    let library =
        target_folder().join(format!("debug/{prefix}_kdray{}", std::env::consts::DLL_SUFFIX));
    let place = package.join(MODULE);
    fs::copy(&library, &place).map_err(|error| told(&library, &error))?;
    Ok(folder.to_owned())
}

fn copy_all(from: &Path, to: &Path) -> Result<(), String> {
    fs::create_dir_all(to).map_err(|error| told(to, &error))?;
    for entry in fs::read_dir(from).map_err(|error| told(from, &error))? {
        let path = entry.map_err(|error| told(from, &error))?.path();
        let name = path.file_name().unwrap_or_default();
        if name == OsStr::new("__pycache__") {
            continue;
        }
        let place = to.join(name);
        if path.is_dir() {
            copy_all(&path, &place)?;
        } else {
            fs::copy(&path, &place).map_err(|error| told(&path, &error))?;
        }
    }
    Ok(())
}

fn mypy_cache(home: &Path) -> Result<String, String> {
    let cache = std::path::absolute(home.join("mypy")).map_err(|error| told(home, &error))?;
    Ok(cache.display().to_string())
}

fn told(path: &Path, error: &std::io::Error) -> String {
    format!("{}: {error}", path.display())
}
