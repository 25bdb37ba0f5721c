//! The Python package, put together from what cargo compiled: a wheel would have to be compiled anew.

use crate::steps::{target_folder, told};
use std::ffi::OsStr;
use std::fs;
use std::path::Path;

/// The package's crate.
pub(crate) const CRATE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../crates/kdray-python");

/// The compiled part by its name in the package, which every Python from 3.9 on finds.
const MODULE: &str = if cfg!(windows) { "_kdray.pyd" } else { "_kdray.abi3.so" };

/// Puts the package together in `folder`, which is to be on Python's path, from the build of a profile: `debug`
/// or `release`.
pub(crate) fn assemble(folder: &Path, profile: &str) -> Result<(), String> {
    let (source, package) = (Path::new(CRATE).join("python/kdray"), folder.join("kdray"));
    // What is not there any more shall not be found.
    let _ = fs::remove_dir_all(&package);
    copy_all(&source, &package)?;
    let (prefix, suffix) = (std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    let library = target_folder().join(profile).join(format!("{prefix}_kdray{suffix}"));
    fs::copy(&library, package.join(MODULE)).map_err(|error| told(&library, &error))?;
    Ok(())
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
