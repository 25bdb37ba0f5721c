//! Rendered pictures.

use crate::error::{FileError, InternalError};
use kdray_render::{PngDepth, Samples, WriteError};
use numpy::{Element, PyArray1, PyArray3, PyArrayMethods};
use pyo3::types::{PyBytes, PyDict, PyDictMethods};
use pyo3::{Bound, PyAny, PyErr, PyResult, Python, pyclass, pymethods};

/// A rendered picture.
#[pyclass(frozen, module = "kdray._kdray")]
#[derive(Debug)]
pub(crate) struct Picture(pub(crate) kdray_render::Picture);

#[pymethods]
impl Picture {
    /// What a PNG shows: (height, width, 4) of u8.
    #[getter]
    fn rgba<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let bytes = py.detach(|| self.0.rgba8()).map_err(refused)?;
        PyArray1::from_vec(py, bytes).reshape([self.0.height, self.0.width, 4])
    }

    /// Each channel, by the names of its layer and its own: (height, width) of f32, or u32 for ids.
    #[getter]
    fn channels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let channels = PyDict::new(py);
        for layer in &self.0.layers {
            for channel in &layer.channels {
                let array = match &channel.samples {
                    Samples::F32(samples) => self.array(py, samples)?,
                    Samples::U32(samples) => self.array(py, samples)?,
                };
                channels.set_item(format!("{}.{}", layer.name, channel.name), array)?;
            }
        }
        Ok(channels)
    }

    /// The bytes of a PNG file of 8 or 16 bits a channel.
    fn png<'py>(&self, py: Python<'py>, bits: u8) -> PyResult<Bound<'py, PyBytes>> {
        let depth = if bits == 16 { PngDepth::Sixteen } else { PngDepth::Eight };
        let mut file = Vec::new();
        py.detach(|| self.0.write_png(&mut file, depth)).map_err(refused)?;
        Ok(PyBytes::new(py, &file))
    }

    /// The bytes of an OpenEXR file of all layers.
    fn exr<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let mut file = std::io::Cursor::new(Vec::new());
        py.detach(|| self.0.write_exr(&mut file)).map_err(refused)?;
        Ok(PyBytes::new(py, file.get_ref()))
    }
}

impl Picture {
    fn array<'py, T: Element>(
        &self,
        py: Python<'py>,
        samples: &[T],
    ) -> PyResult<Bound<'py, PyAny>> {
        let flat = PyArray1::from_slice(py, samples);
        flat.reshape([self.0.height, self.0.width]).map(Bound::into_any)
    }
}

/// That a picture cannot be encoded.
fn refused(error: WriteError) -> PyErr {
    match error {
        WriteError::NotThere(_) => InternalError::new_err(error.to_string()),
        _ => FileError::new_err(error.to_string()),
    }
}
