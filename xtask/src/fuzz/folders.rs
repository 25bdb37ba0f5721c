//! Where fuzzing keeps what.

use std::fs;
use std::path::{Path, PathBuf};

/// The folders below `fuzz/`.
pub(super) struct Folders(PathBuf);

impl Folders {
    pub(super) fn new() -> Self {
        let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz");
        // So that paths are short where they are told.
        Self(beside.canonicalize().unwrap_or(beside))
    }

    /// The workspace of the programs.
    pub(super) fn home(&self) -> &Path {
        &self.0
    }

    /// Where programs are compiled.
    pub(super) fn target(&self) -> PathBuf {
        self.0.join("target")
    }

    /// What is in the repository.
    pub(super) fn corpus(&self, target: &str) -> PathBuf {
        self.0.join("corpus").join(target)
    }

    /// What a target's program is told: flags in libFuzzer's form.
    pub(super) fn options(&self, target: &str) -> PathBuf {
        self.0.join("options").join(target).with_extension("options")
    }

    /// What is not in the repository: a folder for each kind.
    pub(super) fn work(&self, kind: &str) -> PathBuf {
        self.0.join("work").join(kind)
    }

    /// What was found by runs.
    pub(super) fn found(&self, target: &str) -> PathBuf {
        self.work("found").join(target)
    }

    /// What was made by code.
    pub(super) fn seeds(&self, target: &str) -> PathBuf {
        self.work("seeds").join(target)
    }

    /// Inputs that fail.
    pub(super) fn artifacts(&self) -> PathBuf {
        self.0.join("artifacts")
    }

    /// How many inputs of a target fail.
    pub(super) fn failures(&self, target: &str) -> usize {
        count(&self.artifacts().join(target))
    }
}

/// How many files are in a folder; none if it is not there.
pub(super) fn count(folder: &Path) -> usize {
    fs::read_dir(folder).map_or(0, Iterator::count)
}

/// Makes a folder.
pub(super) fn make(folder: &Path) -> Result<(), String> {
    fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))
}
