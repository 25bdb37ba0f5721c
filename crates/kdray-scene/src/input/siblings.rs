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
    /// Opens what a file calls `name`. Backslashes count as slashes. Only regular files below the
    /// folder, or beside it by `..`, are opened: never an absolute path, which means something only
    /// on the machine that wrote it; there, the last component is tried instead.
    pub(crate) fn open(self, name: &str) -> io::Result<(PathBuf, File)> {
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
        let file = File::open(&path)?;
        Ok((path, file))
    }

    /// All bytes of the file, which may have at most `limit`.
    pub(crate) fn read(self, name: &str, limit: u64) -> io::Result<Vec<u8>> {
        let (_, file) = self.open(name)?;
        let mut bytes = Vec::new();
        super::Limited::new(file, limit).read_to_end(&mut bytes)?;
        Ok(bytes)
    }
}
