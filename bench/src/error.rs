//! What can go wrong in a run.

use kdray::{BuildError, MeshError};
use kdray_render::CameraError;
use kdray_scene::LoadError;
use std::{io, path::Path};
use thiserror::Error;

/// Why a run ends, or goes on without a contender.
#[derive(Debug, Error)]
pub(crate) enum BenchError {
    /// The arguments ask for what is not there.
    #[error("{0}")]
    Usage(String),
    /// A scene cannot be read.
    #[error(transparent)]
    Load(#[from] LoadError),
    /// A scene's triangles cannot be used.
    #[error("{0}")]
    Mesh(#[from] MeshError),
    /// A camera cannot be used.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// A tree cannot be built.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// A file cannot be read or written.
    #[error("{file}: {error}")]
    Io {
        /// Its name.
        file: String,
        /// Why.
        error: io::Error,
    },
    /// Embree is not to be had, or refuses.
    #[error("Embree: {0}")]
    Embree(String),
    /// A contender cannot do its work.
    #[error("{0}")]
    Contender(String),
}

impl BenchError {
    /// An error of `path`.
    pub(crate) fn io(path: &Path, error: impl Into<io::Error>) -> Self {
        Self::Io { file: path.display().to_string(), error: error.into() }
    }
}
