//! Files mapped into memory. The one crate of kdray with `unsafe` in it, and one call of it: all else
//! is in `memmap2`.

#![deny(unsafe_op_in_unsafe_fn)]

use std::fs::File;
use std::io;

/// The content of a file as it lies in the system's page cache: bytes are read from the disk when they
/// are first looked at, and shared with all others who map the file.
///
/// **The file must stay as it is** for as long as it is mapped. Programs that put a new file in its
/// place, by renaming, as kdray does, leave the old one to those who map it. A program that writes
/// into the file itself changes what others have mapped; one that cuts it short ends them by a signal
/// (`SIGBUS`) when they look behind its end. Do not map files that such programs may write; read them.
#[derive(Debug)]
pub struct Map(memmap2::Mmap);

impl Map {
    /// Maps a whole file, for reading.
    ///
    /// # Errors
    /// What the system says; files that are empty, or are no files but pipes or folders, cannot be
    /// mapped on every system.
    #[expect(unsafe_code, reason = "the one call, as the documentation of the crate says")]
    pub fn new(file: &File) -> io::Result<Self> {
        // SAFETY: the mapping is a valid slice for as long as `Map` owns it, of bytes, for which every
        // pattern is valid. What the compiler cannot see is whether somebody else changes the file
        // meanwhile. No program can rule that out; it is what the documentation of `Map` asks of users.
        // Here nothing ever writes into a file that it did not just create under a name of its own.
        unsafe { memmap2::Mmap::map(file) }.map(Self)
    }
}

impl AsRef<[u8]> for Map {
    fn as_ref(&self) -> &[u8] {
        &self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    #[test]
    fn what_was_written_is_mapped() -> io::Result<()> {
        let path = std::env::temp_dir().join(format!("kdray-map-{}", std::process::id()));
        File::create_new(&path)?.write_all(b"what was written")?;
        let map = Map::new(&File::open(&path)?)?;
        std::fs::remove_file(&path)?;
        assert_eq!(map.as_ref(), b"what was written");
        assert_eq!(map.as_ref().as_ptr().addr() % 4096, 0, "it begins where a page does");
        Ok(())
    }
}
