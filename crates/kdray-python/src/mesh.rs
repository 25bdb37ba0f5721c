//! Triangles that are checked and copied, before a tree is built over them.

use crate::error::{ArgumentError, argument};
use crate::rows::Floats;
use kdray::{Coordinate, MeshError, TriangleMesh};
use numpy::{Element, PyArray1, PyArrayMethods, PyReadonlyArray2};
use pyo3::{Bound, PyAny, PyErr, PyResult, Python, pyclass, pymethods};

/// Triangles of one geometry.
#[pyclass(frozen, module = "kdray._kdray")]
#[derive(Debug)]
pub(crate) struct Mesh(pub(crate) AnyMesh);

/// In the precision of its vertices.
#[derive(Clone, Debug)]
pub(crate) enum AnyMesh {
    F32(TriangleMesh<f32>),
    F64(TriangleMesh<f64>),
}

#[pymethods]
impl Mesh {
    /// Copies arrays that are contiguous in the order of C.
    #[new]
    fn new(
        py: Python<'_>,
        vertices: Floats<'_>,
        faces: PyReadonlyArray2<'_, u32>,
    ) -> PyResult<Self> {
        let contiguous = |name, error| argument(name, format!("give a contiguous array: {error}"));
        let faces = faces.as_slice().map_err(|error| contiguous("faces", error))?;
        let mesh = match &vertices {
            Floats::F32(array) => {
                let vertices = array.as_slice().map_err(|error| contiguous("vertices", error))?;
                py.detach(|| mesh(vertices, faces)).map(AnyMesh::F32)
            }
            Floats::F64(array) => {
                let vertices = array.as_slice().map_err(|error| contiguous("vertices", error))?;
                py.detach(|| mesh(vertices, faces)).map(AnyMesh::F64)
            }
        };
        mesh.map(Self)
    }

    /// How many triangles there are.
    #[getter]
    fn face_count(&self) -> usize {
        self.0.len()
    }

    /// How many vertices there are.
    #[getter]
    fn vertex_count(&self) -> usize {
        match &self.0 {
            AnyMesh::F32(mesh) => mesh.vertices().len(),
            AnyMesh::F64(mesh) => mesh.vertices().len(),
        }
    }

    /// Whether its vertices are f64.
    #[getter]
    fn is_double(&self) -> bool {
        self.0.is_double()
    }

    /// A copy of the vertices.
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        match &self.0 {
            AnyMesh::F32(mesh) => rows(py, mesh.vertices()),
            AnyMesh::F64(mesh) => rows(py, mesh.vertices()),
        }
    }

    /// A copy of the faces.
    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, self.0.triangles())
    }
}

impl AnyMesh {
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::F32(mesh) => mesh.triangles().len(),
            Self::F64(mesh) => mesh.triangles().len(),
        }
    }

    pub(crate) fn is_double(&self) -> bool {
        matches!(self, Self::F64(_))
    }

    pub(crate) fn triangles(&self) -> &[[u32; 3]] {
        match self {
            Self::F32(mesh) => mesh.triangles(),
            Self::F64(mesh) => mesh.triangles(),
        }
    }
}

/// A copy of vectors, as an array of as many rows.
pub(crate) fn rows<'py, T: Element>(
    py: Python<'py>,
    vectors: &[[T; 3]],
) -> PyResult<Bound<'py, PyAny>> {
    let flat = PyArray1::from_slice(py, vectors.as_flattened());
    flat.reshape([vectors.len(), 3]).map(Bound::into_any)
}

/// A mesh of flat arrays.
fn mesh<T: Coordinate>(vertices: &[T], faces: &[u32]) -> PyResult<TriangleMesh<T>> {
    let (vertices, rest) = vertices.as_chunks::<3>();
    if !rest.is_empty() {
        return Err(argument("vertices", "give an array of shape (n, 3)"));
    }
    let (faces, rest) = faces.as_chunks::<3>();
    if !rest.is_empty() {
        return Err(argument("faces", "give an array of shape (m, 3)"));
    }
    TriangleMesh::new(vertices.to_vec(), faces.to_vec()).map_err(refused)
}

/// That a mesh cannot be used, by the name of the argument that is to blame.
pub(crate) fn refused(error: MeshError) -> PyErr {
    let name = match error {
        MeshError::NonFiniteVertex { .. } | MeshError::TooManyVertices(_) => "vertices",
        _ => "faces",
    };
    ArgumentError::new_err(format!("{name}: {error}"))
}
