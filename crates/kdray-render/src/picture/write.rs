//! Files that are there in full or not at all.

use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;
use thiserror::Error;

/// Why a picture could not be written.
#[derive(Debug, Error)]
pub enum WriteError {
    /// The file or its folder cannot be written to.
    #[error("cannot write {path}: {source}; choose another place, or mend its permissions")]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The path names something else than a file.
    #[error("cannot write {path}: it is there already, and is not a file; choose another name")]
    NotAFile {
        /// The path.
        path: PathBuf,
    },
    /// The picture does not fit the format.
    #[error("cannot encode {path}: {reason}")]
    Encode {
        /// The file.
        path: PathBuf,
        /// What the encoder says.
        reason: String,
    },
}

/// Has `encode` write a file under a temporary name in the folder of `path`, and renames it to
/// `path`; so an older file stays as it is until the new one is complete.
pub(crate) fn replace_file(
    path: &Path,
    encode: impl FnOnce(&mut BufWriter<&mut NamedTempFile>) -> Result<(), String>,
) -> Result<(), WriteError> {
    let failed = |source| WriteError::Io { path: path.into(), source };
    let target = target(path)?;
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty());
    let mut file = temporary_file(folder.unwrap_or(Path::new("."))).map_err(failed)?;
    let mut writer = BufWriter::new(&mut file);
    encode(&mut writer).map_err(|reason| WriteError::Encode { path: path.into(), reason })?;
    writer.flush().map_err(failed)?;
    drop(writer);
    file.persist(&target).map_err(|e| failed(e.error))?;
    Ok(())
}

/// The file to replace: where a symbolic link leads to. A folder or a device is refused.
fn target(path: &Path) -> Result<PathBuf, WriteError> {
    match path.metadata() {
        Ok(found) if !found.is_file() => Err(WriteError::NotAFile { path: path.into() }),
        Ok(_) => path.canonicalize().map_err(|source| WriteError::Io { path: path.into(), source }),
        Err(_) => Ok(path.into()),
    }
}

fn temporary_file(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".kdray-");
    // As for any new file, the umask decides who may read it.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_failed_encoding_leaves_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture");
        replace_file(&path, |w| w.write_all(b"old").map_err(|e| e.to_string())).unwrap();
        let failed = replace_file(&path, |w| {
            w.write_all(b"new").map_err(|e| e.to_string())?;
            Err("no".into())
        });
        assert!(matches!(failed, Err(WriteError::Encode { .. })));
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "nothing else is left behind");
    }

    #[test]
    fn places_that_cannot_be_written_are_named() {
        let folder = tempfile::tempdir().unwrap();
        let missing = folder.path().join("no/such/picture.png");
        let Err(error) = replace_file(&missing, |_| Ok(())) else { panic!() };
        assert!(error.to_string().contains("picture.png"), "{error}");
        let at_folder = replace_file(folder.path(), |_| Ok(()));
        assert!(matches!(at_folder, Err(WriteError::NotAFile { .. })));
    }
}
