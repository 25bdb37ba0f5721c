//! A built scene.

use crate::all_hits::{all_hits, count};
use crate::any_hit::any_hit;
use crate::build;
use crate::cast::Found;
use crate::closest_hit::closest_hit;
use crate::columns::Arrays;
use crate::job::{Control, Job};
use crate::mesh::{Mesh, rows};
use crate::rays::{RayArguments, Rays};
use crate::surface;
use kdray::{InstancedScene, Scene};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1, PyUntypedArrayMethods};
use pyo3::{Bound, Py, PyAny, PyResult, Python, pyclass, pymethods};
use std::sync::Arc;

/// A built scene, to be asked from any thread.
#[pyclass(frozen, module = "kdray._kdray")]
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    pub(crate) kind: Kind,
    pub(crate) places: Places,
}

/// What is asked.
#[derive(Clone, Debug)]
pub(crate) enum Kind {
    F32(Scene<f32>),
    F64(Scene<f64>),
    Copies32(InstancedScene<f32>),
    Copies64(InstancedScene<f64>),
}

/// Calls for whatever scene a tree is of.
macro_rules! for_scene {
    ($tree:expr, $scene:ident => $answer:expr) => {
        match &$tree.kind {
            $crate::tree::Kind::F32($scene) => $answer,
            $crate::tree::Kind::F64($scene) => $answer,
            $crate::tree::Kind::Copies32($scene) => $answer,
            $crate::tree::Kind::Copies64($scene) => $answer,
        }
    };
}
pub(crate) use for_scene;

impl From<Kind> for Tree {
    /// All of it is one geometry.
    fn from(kind: Kind) -> Self {
        Self { kind, places: Places::One }
    }
}

/// Which geometry a triangle of the scene is part of.
#[derive(Clone, Debug)]
pub(crate) enum Places {
    /// All are of the same.
    One,
    /// Those of each geometry follow those of the one before: the first of each.
    Many(Arc<[u32]>),
    /// The scene tells. How many instances the user placed; those behind them stand for geometries that
    /// are not placed.
    Instances(u32),
}

/// The ids of what was hit, as the user has them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) primitive_id: i32,
    pub(crate) geometry_id: i32,
    pub(crate) instance_id: i32,
}

impl Places {
    /// Whether there are several geometries.
    pub(crate) fn are_many(&self) -> bool {
        !matches!(self, Self::One)
    }

    /// Whether there are instances.
    pub(crate) fn are_instances(&self) -> bool {
        matches!(self, Self::Instances(_))
    }

    /// The index of a triangle among those of all geometries, if it may be there; not where there are
    /// instances.
    pub(crate) fn index(&self, primitive_id: i32, geometry_id: i32) -> Option<u32> {
        let primitive = u32::try_from(primitive_id).ok()?;
        match self {
            Self::One => Some(primitive),
            Self::Many(firsts) => {
                let first = firsts.get(usize::try_from(geometry_id).ok()?)?;
                first.checked_add(primitive)
            }
            Self::Instances(_) => None,
        }
    }

    /// The place of a hit. Ids are less than 2^30.
    pub(crate) fn of(&self, found: &Found) -> Place {
        let id = found.hit.primitive_id;
        match self {
            Self::One => Place { primitive_id: id as i32, geometry_id: 0, instance_id: -1 },
            Self::Many(firsts) => {
                let geometry = firsts.partition_point(|&first| first <= id) - 1;
                let primitive_id = (id - firsts[geometry]) as i32;
                Place { primitive_id, geometry_id: geometry as i32, instance_id: -1 }
            }
            Self::Instances(placed) => {
                let (instance, geometry) = found.instance.unwrap_or_default();
                let instance_id = if instance < *placed { instance as i32 } else { -1 };
                Place { primitive_id: id as i32, geometry_id: geometry as i32, instance_id }
            }
        }
    }
}

/// So many rays are answered at once, on the thread that asks.
const FEW: usize = 512;

#[pymethods]
impl Tree {
    /// Builds the tree over all meshes together, or over copies of them, if there are any.
    #[staticmethod]
    #[pyo3(signature = (meshes, copies, *, is_double, preset, split, leaf_size, max_depth, memory_limit, threads, progress))]
    #[expect(clippy::too_many_arguments, reason = "they are those of the package's own method")]
    fn build(
        py: Python<'_>,
        meshes: Vec<Py<Mesh>>,
        copies: build::Copies,
        is_double: bool,
        preset: Option<&str>,
        split: Option<&str>,
        leaf_size: Option<i64>,
        max_depth: Option<i64>,
        memory_limit: Option<i64>,
        threads: Option<i64>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let options = build::options(preset, split, leaf_size, max_depth, memory_limit)?;
        let meshes: Vec<&Mesh> = meshes.iter().map(Py::get).collect();
        let job = Job::new(threads, progress)?;
        match copies.is_empty() {
            true => build::build(py, &meshes, is_double, &options, &job),
            false => build::build_instanced(py, &meshes, copies, is_double, &options, &job),
        }
    }

    /// The box around all triangles; none without any.
    #[getter]
    fn bounds<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let corners = py.detach(|| surface::bounds(self));
        corners.map(|corners| rows(py, &corners)).transpose()
    }

    /// How many triangles there are, those of each geometry once.
    #[getter]
    fn face_count(&self) -> usize {
        surface::meshes(self).iter().map(|mesh| mesh.triangles().len()).sum()
    }

    /// Whether the vertices are f64.
    #[getter]
    fn is_double(&self) -> bool {
        matches!(self.kind, Kind::F64(_) | Kind::Copies64(_))
    }

    /// A copy of the vertices of all geometries.
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        surface::vertices(self, py)
    }

    /// A copy of the faces of all geometries.
    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, &py.detach(|| surface::faces(self)))
    }

    /// The unit normals of triangles.
    #[pyo3(signature = (primitive_id, geometry_id, instance_id, *, threads))]
    fn normals<'py>(
        &self,
        py: Python<'py>,
        primitive_id: PyReadonlyArray1<'py, i32>,
        geometry_id: PyReadonlyArray1<'py, i32>,
        instance_id: PyReadonlyArray1<'py, i32>,
        threads: Option<i64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let ids = [&primitive_id, &geometry_id, &instance_id].map(PyReadonlyArray1::as_array);
        let (job, count) = (Job::new(threads, None)?, primitive_id.len());
        let work = |control: &Control| surface::normals(self, ids, control);
        rows(py, &job.answer(py, (count, FEW), work)?)
    }

    /// The points of triangles that have these weights.
    #[pyo3(signature = (primitive_id, geometry_id, instance_id, u, v, *, threads))]
    #[expect(clippy::too_many_arguments, reason = "they are those of the package's own method")]
    fn positions<'py>(
        &self,
        py: Python<'py>,
        primitive_id: PyReadonlyArray1<'py, i32>,
        geometry_id: PyReadonlyArray1<'py, i32>,
        instance_id: PyReadonlyArray1<'py, i32>,
        u: PyReadonlyArray1<'py, f64>,
        v: PyReadonlyArray1<'py, f64>,
        threads: Option<i64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let ids = [&primitive_id, &geometry_id, &instance_id].map(PyReadonlyArray1::as_array);
        let weights = [u.as_array(), v.as_array()];
        let (job, count) = (Job::new(threads, None)?, primitive_id.len());
        let work = |control: &Control| surface::positions(self, ids, weights, control);
        rows(py, &job.answer(py, (count, FEW), work)?)
    }

    /// The closest hit of each ray.
    #[pyo3(signature = (rays, *, is_double, lenient, mask, threads, progress))]
    #[expect(clippy::too_many_arguments, reason = "they are those of the package's own method")]
    fn closest_hit<'py>(
        &self,
        py: Python<'py>,
        rays: RayArguments<'py>,
        is_double: bool,
        lenient: bool,
        mask: u32,
        threads: Option<i64>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Arrays<'py>> {
        let (rays, job) = (Rays::new(&rays, lenient)?, Job::new(threads, progress)?);
        let tree = self.seen_by(mask);
        if is_double {
            let answer = run(py, &job, &rays, |control| closest_hit::<f64>(&tree, &rays, control));
            answer.map(|columns| columns.into_arrays(py))
        } else {
            let answer = run(py, &job, &rays, |control| closest_hit::<f32>(&tree, &rays, control));
            answer.map(|columns| columns.into_arrays(py))
        }
    }

    /// Whether each ray hits anything.
    #[pyo3(signature = (rays, *, lenient, mask, threads, progress))]
    fn any_hit<'py>(
        &self,
        py: Python<'py>,
        rays: RayArguments<'py>,
        lenient: bool,
        mask: u32,
        threads: Option<i64>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let (rays, job) = (Rays::new(&rays, lenient)?, Job::new(threads, progress)?);
        let tree = self.seen_by(mask);
        let answer = run(py, &job, &rays, |control| any_hit(&tree, &rays, control));
        answer.map(|found| found.into_pyarray(py))
    }

    /// How many surfaces each ray crosses.
    #[pyo3(signature = (rays, *, lenient, mask, threads, progress))]
    fn count<'py>(
        &self,
        py: Python<'py>,
        rays: RayArguments<'py>,
        lenient: bool,
        mask: u32,
        threads: Option<i64>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let (rays, job) = (Rays::new(&rays, lenient)?, Job::new(threads, progress)?);
        let tree = self.seen_by(mask);
        let answer = run(py, &job, &rays, |control| count(&tree, &rays, control));
        answer.map(|counts| counts.into_pyarray(py))
    }

    /// All hits of each ray, one ray after the other, and where those of each begin and end.
    #[pyo3(signature = (rays, *, is_double, limit, lenient, mask, threads, progress))]
    #[expect(clippy::too_many_arguments, reason = "they are those of the package's own method")]
    fn all_hits<'py>(
        &self,
        py: Python<'py>,
        rays: RayArguments<'py>,
        is_double: bool,
        limit: Option<usize>,
        lenient: bool,
        mask: u32,
        threads: Option<i64>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(Bound<'py, PyArray1<i64>>, Arrays<'py>)> {
        let (rays, job) = (Rays::new(&rays, lenient)?, Job::new(threads, progress)?);
        let tree = self.seen_by(mask);
        let limit = limit.unwrap_or(usize::MAX);
        if is_double {
            let answer =
                run(py, &job, &rays, |control| all_hits::<f64>(&tree, &rays, limit, control));
            answer.map(|(offsets, hits)| (offsets.into_pyarray(py), hits.into_arrays(py)))
        } else {
            let answer =
                run(py, &job, &rays, |control| all_hits::<f32>(&tree, &rays, limit, control));
            answer.map(|(offsets, hits)| (offsets.into_pyarray(py), hits.into_arrays(py)))
        }
    }
}

impl Tree {
    /// The same for rays that see the instances whose mask shares a bit with theirs.
    fn seen_by(&self, mask: u32) -> Self {
        let mut tree = self.clone();
        match &mut tree.kind {
            Kind::Copies32(scene) => *scene = scene.clone().with_mask(mask),
            Kind::Copies64(scene) => *scene = scene.clone().with_mask(mask),
            Kind::F32(_) | Kind::F64(_) => {}
        }
        tree
    }
}

/// Asks about rays, about a few at once.
fn run<R: Send>(
    py: Python<'_>,
    job: &Job,
    rays: &Rays<'_>,
    work: impl FnOnce(&Control) -> PyResult<R> + Send,
) -> PyResult<R> {
    job.answer(py, (rays.len(), FEW), work)
}
