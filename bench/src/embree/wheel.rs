//! Embree out of the Python package `embreex`, which bundles it.

use crate::error::BenchError;
use crate::report::say;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use zip::ZipArchive;

/// The package that the figures in the records were taken with.
const PACKAGE: &str = "embreex==4.4.0.post1";

/// The folder of shared libraries in it.
const LIBRARIES: &str = "embreex.libs/";

/// The path of the library below `folder`, where it is put on the first call.
pub(super) fn library(folder: &Path) -> Result<PathBuf, BenchError> {
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        let reason = "it is fetched for Linux on x86-64 only";
        return Err(BenchError::Embree(reason.to_owned()));
    }
    let home = folder.join(PACKAGE.replace("==", "-"));
    if let Some(found) = find(&home, "libembree4") {
        return Ok(found);
    }
    let fail = |error| BenchError::io(folder, error);
    fs::create_dir_all(folder).map_err(fail)?;
    let temporary = tempfile::tempdir_in(folder).map_err(fail)?;
    download(temporary.path())?;
    let wheel = find(temporary.path(), "embreex").ok_or_else(|| {
        BenchError::Embree(format!("pip left no wheel of {PACKAGE} in {}", folder.display()))
    })?;
    let unpacked = temporary.path().join("libraries");
    unpack(&wheel, &unpacked)?;
    fs::rename(&unpacked, &home).map_err(fail)?;
    find(&home, "libembree4")
        .ok_or_else(|| BenchError::Embree(format!("{PACKAGE} has no libembree4")))
}

/// The first file in `folder` whose name begins so.
fn find(folder: &Path, name: &str) -> Option<PathBuf> {
    let entries = fs::read_dir(folder).ok()?.flatten();
    entries
        .map(|entry| entry.path())
        .find(|path| path.file_name().is_some_and(|file| file.to_string_lossy().starts_with(name)))
}

/// Asks pip for the wheel. Any Python's will do, as only the libraries are taken out of it.
fn download(folder: &Path) -> Result<(), BenchError> {
    say(&format!("fetching {PACKAGE}, which bundles Embree, with pip (once)"));
    let output = Command::new("python3")
        .args(["-m", "pip", "download", "--no-deps", "--only-binary=:all:", "--quiet"])
        .args(["--python-version", "3.11", "--platform", "manylinux_2_28_x86_64"])
        .args(["--disable-pip-version-check", "--dest"])
        .args([folder.as_os_str(), PACKAGE.as_ref()])
        .output()
        .map_err(|error| BenchError::Embree(format!("python3 cannot be started: {error}")))?;
    if output.status.success() {
        return Ok(());
    }
    let text = String::from_utf8_lossy(&output.stderr);
    let last = text.lines().last().unwrap_or("it says nothing").to_owned();
    Err(BenchError::Embree(format!("pip cannot fetch {PACKAGE}: {last}")))
}

/// Takes the shared libraries out of a wheel.
fn unpack(wheel: &Path, folder: &Path) -> Result<(), BenchError> {
    let fail = |error: io::Error| BenchError::io(wheel, error);
    fs::create_dir_all(folder).map_err(fail)?;
    let mut archive =
        ZipArchive::new(File::open(wheel).map_err(fail)?).map_err(|error| fail(error.into()))?;
    for index in 0..archive.len() {
        let mut entry = archive.by_index(index).map_err(|error| fail(error.into()))?;
        let name = entry.name().map(|name| name.to_string()).unwrap_or_default();
        let Some(file) = name.strip_prefix(LIBRARIES).filter(|file| is_plain(file)) else {
            continue;
        };
        let mut output = File::create(folder.join(file)).map_err(fail)?;
        io::copy(&mut entry, &mut output).map_err(fail)?;
    }
    Ok(())
}

/// Whether it is the name of a file, and not of a folder or of something elsewhere.
fn is_plain(name: &str) -> bool {
    !name.is_empty() && !name.contains(['/', '\\']) && !name.starts_with('.')
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;
    use zip::{ZipWriter, write::SimpleFileOptions};

    #[test]
    fn only_libraries_are_unpacked() {
        let folder = tempfile::tempdir().unwrap();
        let wheel = folder.path().join("embreex-0.whl");
        let mut archive = ZipWriter::new(File::create(&wheel).unwrap());
        for name in ["embreex/code.py", "embreex.libs/libembree4-1.so.4", "embreex.libs/../evil"] {
            archive.start_file(name, SimpleFileOptions::default()).unwrap();
            archive.write_all(name.as_bytes()).unwrap();
        }
        archive.finish().unwrap();
        let out = folder.path().join("out");
        unpack(&wheel, &out).unwrap();
        let names: Vec<_> = fs::read_dir(&out).unwrap().map(|it| it.unwrap().file_name()).collect();
        assert_eq!(names, ["libembree4-1.so.4"]);
        assert!(find(&out, "libembree4").is_some() && find(&out, "libtbb").is_none());
    }
}
