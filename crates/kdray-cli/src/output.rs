//! Output files, complete or not there at all; and standard output.

use crate::{error::CliError, interrupt};
use std::{
    fs::{self, File},
    io::{self, Write},
    path::{Path, PathBuf},
};
use tempfile::NamedTempFile;

/// Writes bytes to standard output.
pub(crate) fn print(bytes: &[u8]) -> Result<(), CliError> {
    let mut stdout = io::stdout().lock();
    stdout.write_all(bytes).and_then(|()| stdout.flush()).map_err(CliError::Stdout)
}

/// A file to be: written under a temporary name beside it, renamed when complete, gone if dropped.
pub(crate) struct Output {
    path: PathBuf,
    sink: Sink,
}

enum Sink {
    Temporary(NamedTempFile),
    /// A device or pipe, which cannot be renamed over.
    Direct(File),
}

impl Output {
    /// Makes sure that `path` can be written, before the work whose result it is to hold.
    pub(crate) fn create(path: &Path) -> Result<Self, CliError> {
        // A link stays a link; what it points to is replaced.
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let sink = Sink::open(&target).map_err(|error| CliError::output(path, error))?;
        Ok(Self { path: target, sink })
    }

    /// Writes a whole file.
    pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), CliError> {
        let mut output = Self::create(path)?;
        output.file().write_all(bytes).map_err(|error| CliError::output(path, error))?;
        output.commit()
    }

    /// The path that the file will have.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Where to write.
    pub(crate) fn file(&mut self) -> &mut File {
        match &mut self.sink {
            Sink::Temporary(file) => file.as_file_mut(),
            Sink::Direct(file) => file,
        }
    }

    /// An unnamed file in the same folder, for parts of the result; gone when closed.
    pub(crate) fn scratch(&self) -> io::Result<File> {
        match &self.sink {
            Sink::Temporary(_) => tempfile::tempfile_in(folder_of(&self.path)),
            Sink::Direct(_) => tempfile::tempfile(),
        }
    }

    /// Gives the file its name.
    pub(crate) fn commit(self) -> Result<(), CliError> {
        if let Sink::Temporary(file) = self.sink {
            let persisted = file.persist(&self.path);
            persisted.map_err(|error| CliError::output(&self.path, error.error))?;
        }
        Ok(())
    }
}

impl Sink {
    fn open(path: &Path) -> io::Result<Self> {
        match fs::metadata(path) {
            Ok(found) if found.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
            Ok(found) if !found.is_file() => {
                return File::options().write(true).open(path).map(Self::Direct);
            }
            Ok(found) if found.permissions().readonly() => {
                return Err(io::ErrorKind::PermissionDenied.into());
            }
            _ => {}
        }
        let mut builder = tempfile::Builder::new();
        builder.prefix(".kdray-").suffix(".part");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // As for any new file; the system's mask still applies.
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        let folder = folder_of(path);
        fs::metadata(folder)?;
        // The kind alone: the message has the temporary name, which says nothing to the user.
        let file = builder.tempfile_in(folder).map_err(|error| io::Error::from(error.kind()))?;
        interrupt::remove_at_exit(file.path().to_owned());
        Ok(Self::Temporary(file))
    }
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
