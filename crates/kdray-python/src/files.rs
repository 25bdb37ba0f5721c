//! Mesh files and tree files.

use crate::error::{FileError, MissingFileError, SceneError, argument};
use crate::job::Job;
use crate::mesh::{AnyMesh, Mesh, refused};
use crate::points::for_points;
use crate::tree::{Kind, Places, Tree};
use kdray::TriangleMesh;
use kdray::file::{AnyScene, HEADER_BYTES, file_bytes};
use kdray_file::{Output, TreeFileError};
use kdray_scene::{LoadError, LoadOptions, Model};
use pyo3::{PyErr, PyResult, Python, pyclass, pyfunction};
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What a file says besides its triangles: materials, lights, cameras.
#[pyclass(frozen, module = "kdray._kdray")]
#[derive(Debug)]
pub(crate) struct Look(pub(crate) Arc<Model>);

/// Reads a mesh file: its triangles, what they look like, and what the user should know.
#[pyfunction]
#[pyo3(signature = (path, *, drop_bad))]
pub(crate) fn read_mesh(
    py: Python<'_>,
    path: PathBuf,
    drop_bad: bool,
) -> PyResult<(Mesh, Look, Vec<String>)> {
    let job = Job::new(None, None)?;
    job.run(py, 1, |_| {
        let options = LoadOptions { drop_bad, ..LoadOptions::default() };
        let model = kdray_scene::load(&path, &options).map_err(refused_file)?;
        let (vertices, triangles) = (model.vertices, model.triangles);
        let mesh = TriangleMesh::new(vertices, triangles).map_err(refused)?;
        let look = Model { vertices: Vec::new(), triangles: Vec::new(), ..model };
        let warnings = look.warnings.clone();
        Ok((Mesh(AnyMesh::F32(mesh)), Look(Arc::new(look)), warnings))
    })
}

/// Whether a file begins as a tree file does.
#[pyfunction]
pub(crate) fn is_tree_file(py: Python<'_>, path: PathBuf) -> PyResult<bool> {
    let asked = py.detach(|| kdray_file::is_tree_file(&path));
    asked.map_err(|source| refused_file(TreeFileError::Io { path, source }))
}

/// Writes bytes to a file, which takes the place of an older one when it is whole.
#[pyfunction]
pub(crate) fn write_file(py: Python<'_>, path: PathBuf, content: &[u8]) -> PyResult<()> {
    let written = py.detach(|| {
        let mut output = Output::create(&path)?;
        output.file().write_all(content)?;
        output.commit()
    });
    written.map_err(|source| refused_file(TreeFileError::Io { path, source }))
}

/// Writes a scene of one geometry to a file.
#[pyfunction]
pub(crate) fn save_tree(py: Python<'_>, tree: &Tree, path: PathBuf) -> PyResult<()> {
    for_points!(tree, scene => {
        if !matches!(tree.places, Places::One) {
            let reason = "a tree file holds one geometry, but the scene has several; join their triangles";
            return Err(SceneError::new_err(reason));
        }
        Job::new(None, None)?.run(py, 1, |_| kdray_file::save(scene, &path).map_err(refused_file))
    })
}

/// Reads a tree file and verifies all of it.
#[pyfunction]
#[pyo3(signature = (path, *, memory_limit, threads))]
pub(crate) fn load_tree(
    py: Python<'_>,
    path: PathBuf,
    memory_limit: Option<i64>,
    threads: Option<i64>,
) -> PyResult<Tree> {
    let bytes = |limit| u64::try_from(limit).map_err(|_| argument("memory_limit", "give bytes"));
    let limit = memory_limit.map(bytes).transpose()?;
    Job::new(threads, None)?
        .run(py, 1, |_| kdray_file::load_any(&path, limit).map(Tree::from).map_err(refused_file))
}

/// Maps a tree file into memory.
#[pyfunction]
pub(crate) fn map_tree(py: Python<'_>, path: PathBuf) -> PyResult<Tree> {
    py.detach(|| kdray_file::map_any(&path)).map(Tree::from).map_err(refused_file)
}

/// The hash of what a tree file holds, which stands in its header.
#[pyfunction]
pub(crate) fn file_hash(py: Python<'_>, path: PathBuf) -> PyResult<String> {
    py.detach(|| {
        let header = match read_header(&path) {
            Ok(header) => header,
            Err(source) => return Err(refused_file(TreeFileError::Io { path, source })),
        };
        hash(&header).map_err(|source| refused_file(TreeFileError::File { path, source }))
    })
}

/// The hash that the file of a scene would have.
#[pyfunction]
pub(crate) fn tree_hash(py: Python<'_>, tree: &Tree) -> PyResult<String> {
    for_points!(tree, scene => {
        // Only the header is wanted.
        let header = py.detach(|| scene.save(|bytes| Err(bytes.to_vec())));
        let header = header.err().unwrap_or_default();
        hash(&header).map_err(|error| FileError::new_err(error.to_string()))
    })
}

impl From<AnyScene> for Tree {
    fn from(scene: AnyScene) -> Self {
        match scene {
            AnyScene::F32(scene) => Self::from(Kind::F32(scene)),
            AnyScene::F64(scene) => Self::from(Kind::F64(scene)),
        }
    }
}

fn read_header(path: &Path) -> std::io::Result<Vec<u8>> {
    let mut header = Vec::with_capacity(HEADER_BYTES);
    File::open(path)?.take(HEADER_BYTES as u64).read_to_end(&mut header)?;
    Ok(header)
}

/// The checksum that ends a header. It covers the header, and so the checksum of all else.
fn hash(header: &[u8]) -> Result<String, kdray::FileError> {
    file_bytes(header)?;
    let checksum = header[..HEADER_BYTES].last_chunk().copied().unwrap_or_default();
    Ok(format!("{:016x}", u64::from_le_bytes(checksum)))
}

/// Why a file is refused.
trait Refusal: ToString {
    /// What the system says about the file, or one that it needs, if it was the system that refused.
    fn of_system(&self) -> Option<io::ErrorKind>;
}

impl Refusal for LoadError {
    fn of_system(&self) -> Option<io::ErrorKind> {
        match self {
            Self::Io { error, .. } | Self::Missing { error, .. } => Some(error.kind()),
            _ => None,
        }
    }
}

impl Refusal for TreeFileError {
    fn of_system(&self) -> Option<io::ErrorKind> {
        match self {
            Self::Io { source, .. } => Some(source.kind()),
            _ => None,
        }
    }
}

/// That a file cannot be read or written.
fn refused_file(error: impl Refusal) -> PyErr {
    match error.of_system() {
        Some(io::ErrorKind::NotFound) => MissingFileError::new_err(error.to_string()),
        _ => FileError::new_err(error.to_string()),
    }
}
