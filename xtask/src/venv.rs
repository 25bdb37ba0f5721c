//! Virtual environments for Python, with the packages that a list names.

use crate::steps::{Steps, told};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Makes a virtual environment with the packages of `list`, if that was not done yet. The Python in it.
pub(crate) fn python(steps: &mut Steps, venv: &Path, list: &Path) -> Result<PathBuf, String> {
    let python = venv.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let wanted = fs::read(list).map_err(|error| told(list, &error))?;
    let mark = venv.join("requirements.txt");
    if fs::read(&mark).is_ok_and(|made_with| made_with == wanted) {
        return Ok(python);
    }
    let mut make = Command::new("python3");
    make.args(["-m", "venv", "--clear"]).arg(venv);
    steps.run("Python, environment", &mut make, "python3 -m venv").map_err(|reason| {
        format!("{reason}; this needs Python 3.11 or newer, with venv (on Debian: apt install python3-venv)")
    })?;
    let mut fetch = Command::new(&python);
    fetch.args(["-m", "pip", "install", "--quiet", "--only-binary=:all:", "-r"]).arg(list);
    let line = format!("pip install -r {}", list.display());
    steps.run("Python, packages, once", &mut fetch, &line)?;
    fs::write(&mark, wanted).map_err(|error| told(&mark, &error))?;
    Ok(python)
}
