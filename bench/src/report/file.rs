//! Output files, complete or not there at all.

use crate::error::BenchError;
use std::io::Write;
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// A file to be: written under a temporary name beside it, and renamed when complete.
pub(super) struct Output {
    path: PathBuf,
    file: NamedTempFile,
}

impl Output {
    /// Makes sure that `path` can be written, before the work whose result it is to hold.
    pub(super) fn create(path: &Path) -> Result<Self, BenchError> {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let mut builder = tempfile::Builder::new();
        builder.prefix(".kdray-").suffix(".part");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // As for any new file; the system's mask still applies.
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        let file = builder.tempfile_in(folder.unwrap_or(Path::new(".")));
        // The kind alone: the message has the temporary name, which says nothing to the user.
        let file = file.map_err(|error| BenchError::io(path, error.kind()))?;
        Ok(Self { path: path.to_owned(), file })
    }

    /// The path that the file will have.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the whole file and gives it its name.
    pub(super) fn write(mut self, bytes: &[u8]) -> Result<(), BenchError> {
        self.file.write_all(bytes).map_err(|error| BenchError::io(&self.path, error))?;
        let persisted = self.file.persist(&self.path);
        persisted.map_err(|error| BenchError::io(&self.path, error.error))?;
        Ok(())
    }
}
