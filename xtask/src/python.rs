//! The Python package: its tests, and whether its types are what they are said to be.

use crate::package::{self, CRATE};
use crate::steps::{Steps, target_folder, told};
use crate::venv;
use std::path::Path;
use std::process::Command;

/// Tests the package in a virtual environment, with what `cargo test` compiled: a wheel, of a release build and
/// other features, would have to be compiled anew.
pub(crate) fn run(steps: &mut Steps) -> Result<(), String> {
    let home = target_folder().join("python");
    let packages = Path::new(CRATE).join("tests/requirements.txt");
    let python = venv::python(steps, &home.join("venv"), &packages)?;
    // All but the package itself was compiled for the tests before. Examples are among what is named, because for them
    // libraries have the features that the tests ask for; without, half of them would be compiled anew.
    steps.cargo("Python, compiled part", "build --workspace --lib --examples", &[])?;
    let package = home.join("package");
    package::assemble(&package, "debug")?;
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

fn mypy_cache(home: &Path) -> Result<String, String> {
    let cache = std::path::absolute(home.join("mypy")).map_err(|error| told(home, &error))?;
    Ok(cache.display().to_string())
}
