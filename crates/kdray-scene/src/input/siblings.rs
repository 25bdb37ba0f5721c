//! The files beside a file: material libraries, textures, buffers.

use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::{Component, Path, PathBuf};

/// Where the files that a file refers to are found.
#[derive(Clone, Copy)]
pub(crate) enum Siblings<'a> {
    /// In this folder.
    In(&'a Path),
    /// Nowhere: the file came as a stream.
    Nowhere,
}

impl Siblings<'_> {
    /// The path of what a file calls `name`, the same for all names of one file. Backslashes count
    /// as slashes. Only regular files below the folder, or beside it by `..`, are found: never an
    /// absolute path, which means something only on the machine that wrote it; there, the last
    /// component is tried instead.
    pub(crate) fn find(self, name: &str) -> io::Result<PathBuf> {
        let Siblings::In(folder) = self else {
            return Err(io::Error::new(ErrorKind::NotFound, "a stream has no files beside it"));
        };
        let name = name.replace('\\', "/");
        let relative = Path::new(&name);
        let foreign = relative
            .components()
            .any(|part| matches!(part, Component::Prefix(_) | Component::RootDir))
            || name.as_bytes().get(1) == Some(&b':');
        let path = if foreign {
            folder.join(relative.file_name().unwrap_or_default())
        } else {
            folder.join(relative)
        };
        // A pipe or a device could block or never end.
        if !std::fs::metadata(&path)?.is_file() {
            return Err(io::Error::new(ErrorKind::InvalidInput, "not a regular file"));
        }
        // Some file systems know no canonical names; there, one name is one file.
        Ok(path.canonicalize().unwrap_or(path))
    }
}

/// All bytes of the file at a path that was found, which may have at most `limit`.
pub(crate) fn read_file(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    super::Limited::new(File::open(path)?, limit).read_to_end(&mut bytes)?;
    Ok(bytes)
}
