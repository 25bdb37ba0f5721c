//! A mesh and rays, out of files.

use crate::error::BenchError;
use crate::rays::Ray;
use kdray::TriangleMesh;
use npyz::{Deserialize, NpyFile};
use std::fs::{self, File};
use std::io::BufReader;
use std::path::{Path, PathBuf};

/// One of the folders.
pub(super) struct Case {
    /// What it is called.
    pub(super) name: String,
    /// Where it lies.
    pub(super) folder: PathBuf,
    /// The mesh.
    pub(super) mesh: TriangleMesh,
    /// The rays, all without end.
    pub(super) rays: Vec<Ray>,
}

impl Case {
    /// All cases in a folder, in the order of their names.
    pub(super) fn all(folder: &Path) -> Result<Vec<Self>, BenchError> {
        let fail = |error| BenchError::io(folder, error);
        let entries = fs::read_dir(folder).map_err(fail)?;
        let mut folders: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
        folders.retain(|folder| folder.join("rays.npy").exists());
        folders.sort();
        folders.into_iter().map(Self::read).collect()
    }

    fn read(folder: PathBuf) -> Result<Self, BenchError> {
        let triples =
            |name: &str| Ok::<_, BenchError>(rows::<f32, 3>(&numbers(&folder.join(name))?));
        let triangles = rows::<u32, 3>(&numbers(&folder.join("triangles.npy"))?);
        let mesh = TriangleMesh::new(triples("vertices.npy")?, triangles)?;
        let rays = rows::<f32, 6>(&numbers(&folder.join("rays.npy"))?);
        let ray = |[x, y, z, a, b, c]: [f32; 6]| Ray {
            origin: [x, y, z],
            direction: [a, b, c],
            t_max: f32::INFINITY,
        };
        let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Self { name, folder, mesh, rays: rays.into_iter().map(ray).collect() })
    }
}

/// The numbers of an array, whatever its shape.
pub(super) fn numbers<T: Deserialize>(path: &Path) -> Result<Vec<T>, BenchError> {
    let fail = |error| BenchError::io(path, error);
    let file = BufReader::new(File::open(path).map_err(fail)?);
    NpyFile::new(file).and_then(NpyFile::into_vec).map_err(fail)
}

fn rows<T: Copy + Default, const N: usize>(numbers: &[T]) -> Vec<[T; N]> {
    numbers.as_chunks().0.to_vec()
}
