//! Files of which nobody knows the precision.

use super::{FileError, coordinate_bits, header::bits_of};
use crate::memory::SharedBytes;
use crate::query::Scene;

/// The scene of a saved file, of the precision that the file has.
#[derive(Clone, Debug)]
pub enum AnyScene {
    /// The vertices are f32.
    F32(Scene<f32>),
    /// The vertices are f64.
    F64(Scene<f64>),
}

impl AnyScene {
    /// [`Scene::load`] of either precision.
    ///
    /// # Errors
    /// See [`FileError`].
    pub fn load(bytes: SharedBytes) -> Result<Self, FileError> {
        if coordinate_bits((*bytes).as_ref())? == bits_of::<f64>() {
            Scene::load(bytes).map(Self::F64)
        } else {
            Scene::load(bytes).map(Self::F32)
        }
    }

    /// [`Scene::open`] of either precision.
    ///
    /// # Errors
    /// See [`FileError`].
    pub fn open(bytes: SharedBytes) -> Result<Self, FileError> {
        if coordinate_bits((*bytes).as_ref())? == bits_of::<f64>() {
            Scene::open(bytes).map(Self::F64)
        } else {
            Scene::open(bytes).map(Self::F32)
        }
    }

    /// [`Scene::verify`] of the scene that it is.
    ///
    /// # Errors
    /// See [`FileError`].
    pub fn verify(&self) -> Result<(), FileError> {
        match self {
            Self::F32(scene) => scene.verify(),
            Self::F64(scene) => scene.verify(),
        }
    }
}
