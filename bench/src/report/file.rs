//! Output files, complete or not there at all.

use crate::error::BenchError;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// A file to be: written under a temporary name beside it, and renamed when complete.
pub(super) struct Output {
    path: PathBuf,
}

impl Output {
    /// Makes sure that `path` can be written, before the work whose result it is to hold. Nothing
    /// is left there if that work is interrupted.
    pub(super) fn create(path: &Path) -> Result<Self, BenchError> {
        let output = Self { path: path.to_owned() };
        output.temporary()?;
        Ok(output)
    }

    /// The path that the file will have.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the whole file and gives it its name.
    pub(super) fn write(self, bytes: &[u8]) -> Result<(), BenchError> {
        let mut file = self.temporary()?;
        file.write_all(bytes).map_err(|error| BenchError::io(&self.path, error))?;
        let persisted = file.persist(&self.path);
        persisted.map_err(|error| BenchError::io(&self.path, error.error))?;
        Ok(())
    }

    fn temporary(&self) -> Result<NamedTempFile, BenchError> {
        if self.path.is_dir() {
            return Err(BenchError::io(&self.path, io::ErrorKind::IsADirectory));
        }
        let folder = self.path.parent().filter(|folder| !folder.as_os_str().is_empty());
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
        file.map_err(|error| BenchError::io(&self.path, error.kind()))
    }
}
