//! Reading the arrays that `kdray query` writes, with a reader that is not ours.

use npyz::{Deserialize, NpyFile};
use std::{fs::File, io::Read, path::Path};
use zip::ZipArchive;

/// An npz file in memory.
pub(crate) struct Npz(Vec<(String, Vec<u8>)>);

impl Npz {
    pub(crate) fn read(path: &Path) -> Self {
        let mut archive = ZipArchive::new(File::open(path).expect("the hits")).expect("a zip");
        let arrays = (0..archive.len()).map(|index| {
            let mut file = archive.by_index(index).expect("an array");
            let name = file.name().expect("text");
            let name = name.strip_suffix(".npy").expect("an npy file").to_owned();
            let mut bytes = Vec::new();
            file.read_to_end(&mut bytes).expect("the bytes, of the right checksum");
            (name, bytes)
        });
        Self(arrays.collect())
    }

    pub(crate) fn names(&self) -> Vec<&str> {
        self.0.iter().map(|(name, _)| name.as_str()).collect()
    }

    /// The numbers of an array, which must be of type T, and its shape.
    pub(crate) fn array<T: Deserialize>(&self, name: &str) -> (Vec<T>, Vec<u64>) {
        let (_, bytes) = self.0.iter().find(|(other, _)| other == name).expect("the array");
        let npy = NpyFile::new(&bytes[..]).expect("an npy file");
        let shape = npy.shape().to_vec();
        (npy.into_vec().expect("numbers of the type"), shape)
    }

    /// The numbers of an array, which must be of type T.
    pub(crate) fn numbers<T: Deserialize>(&self, name: &str) -> Vec<T> {
        self.array(name).0
    }
}
