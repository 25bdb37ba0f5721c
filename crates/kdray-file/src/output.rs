//! Files that are whole or not there at all.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// A file to be: written under a temporary name beside it, renamed when complete, gone if dropped. Whoever reads or
/// has mapped an older file of that name keeps that one.
///
/// A link stays a link, and what it points to is replaced; the new file has the permissions of the old one. A device
/// or a pipe, which cannot be renamed over, is written to.
#[derive(Debug)]
pub struct Output {
    path: PathBuf,
    sink: Sink,
}

#[derive(Debug)]
enum Sink {
    Temporary(NamedTempFile),
    /// A device or pipe.
    Direct(File),
}

impl Output {
    /// Makes sure that `path` can be written, before the work whose result it is to hold.
    ///
    /// # Errors
    /// If it is a folder, a file that must not be written to, or in a folder of which that is so.
    pub fn create(path: &Path) -> io::Result<Self> {
        let path = resolved(path)?;
        let sink = Sink::open(&path)?;
        Ok(Self { path, sink })
    }

    /// The path that the file will have.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The path that it has until then.
    pub fn temporary_path(&self) -> Option<&Path> {
        match &self.sink {
            Sink::Temporary(file) => Some(file.path()),
            Sink::Direct(_) => None,
        }
    }

    /// Where to write.
    pub fn file(&mut self) -> &mut File {
        match &mut self.sink {
            Sink::Temporary(file) => file.as_file_mut(),
            Sink::Direct(file) => file,
        }
    }

    /// An unnamed file in the same folder, for parts of the result; gone when closed.
    ///
    /// # Errors
    /// If there cannot be one.
    pub fn scratch(&self) -> io::Result<File> {
        match &self.sink {
            Sink::Temporary(_) => tempfile::tempfile_in(folder_of(&self.path)),
            Sink::Direct(_) => tempfile::tempfile(),
        }
    }

    /// Gives the file its name, once all of it is on the disk.
    ///
    /// # Errors
    /// If that cannot be done. What was at the path is still there then.
    pub fn commit(self) -> io::Result<()> {
        if let Sink::Temporary(file) = self.sink {
            file.as_file().sync_all()?;
            file.persist(&self.path).map_err(|error| error.error)?;
        }
        Ok(())
    }
}

impl Sink {
    fn open(path: &Path) -> io::Result<Self> {
        let found = match fs::metadata(path) {
            Ok(found) => Some(found),
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(error) => return Err(error),
        };
        match &found {
            Some(found) if found.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
            Some(found) if !found.is_file() => {
                return File::options().write(true).open(path).map(Self::Direct);
            }
            Some(found) if found.permissions().readonly() => {
                return Err(io::ErrorKind::PermissionDenied.into());
            }
            // Others than its owner may be allowed to write to it, or the owner alone.
            Some(_) => drop(File::options().write(true).open(path)?),
            None => {}
        }
        let mut builder = tempfile::Builder::new();
        builder.prefix(".kdray-").suffix(".part");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // Those of a new file are what the system's mask leaves of all.
            let mode = found.as_ref().map_or(0o666, |found| found.permissions().mode() & 0o777);
            builder.permissions(fs::Permissions::from_mode(mode));
        }
        let folder = folder_of(path);
        fs::metadata(folder)?;
        // The kind alone: the message has the temporary name, which says nothing to the user.
        let file = builder.tempfile_in(folder).map_err(|error| io::Error::from(error.kind()))?;
        if let Some(found) = found {
            // Bits that the system's mask took. Who may read no more than this may as well go on.
            let _ = file.as_file().set_permissions(found.permissions());
        }
        Ok(Self::Temporary(file))
    }
}

/// Where links lead, also those to what is not there yet.
fn resolved(path: &Path) -> io::Result<PathBuf> {
    const MOST_LINKS: usize = 40;
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        if let Ok(found) = fs::canonicalize(&path) {
            return Ok(found);
        }
        if fs::metadata(&path).is_ok() {
            // A pipe without a name, such as the standard output may be.
            return Ok(path);
        }
        match fs::read_link(&path) {
            Ok(target) => path = folder_of(&path).join(target),
            Err(_) if path.file_name().is_none() || ends_as_folder(&path) => {
                return Err(io::ErrorKind::IsADirectory.into());
            }
            Err(_) => return Ok(path),
        }
    }
    Err(io::Error::new(io::ErrorKind::InvalidInput, "links that lead to each other"))
}

fn ends_as_folder(path: &Path) -> bool {
    let bytes = path.as_os_str().as_encoded_bytes();
    bytes.ends_with(b"/") || bytes.ends_with(b"/.")
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
