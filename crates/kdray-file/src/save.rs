//! Writing.

use crate::TreeFileError;
use kdray::{Precision, Scene};
use std::io::Write;
use std::path::Path;

/// Writes a scene to a file: under a temporary name in the same folder, which becomes `path` when all is
/// written. So whoever has mapped or is reading an older file at `path` keeps that one, and a file at
/// `path` is whole.
///
/// # Errors
/// [`TreeFileError::Io`].
pub fn save<T: Precision>(scene: &Scene<T>, path: &Path) -> Result<(), TreeFileError> {
    let error = |source| TreeFileError::io(path, source);
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".kdray-").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As for any new file; the system's mask still applies.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(folder).map_err(error)?;
    scene.save(|bytes| file.write_all(bytes)).map_err(error)?;
    file.persist(path).map_err(|persist| error(persist.error))?;
    Ok(())
}
