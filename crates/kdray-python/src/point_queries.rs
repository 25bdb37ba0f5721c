//! What is asked about points.

use crate::closest_point::{self as nearest, Arrays};
use crate::columns::Real;
use crate::error::{ArgumentError, argument};
use crate::job::{Control, Job};
use crate::points::{self, Points, Surface, each_block, each_point, for_points};
use crate::rows::Floats;
use crate::tree::Tree;
use kdray::Side;
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1, PyUntypedArrayMethods};
use pyo3::{Bound, Py, PyAny, PyResult, Python, pyfunction};

/// So many points are answered at once, on the thread that asks.
const FEW: usize = 64;

/// Whether each point is inside or on the surface.
#[pyfunction]
#[pyo3(signature = (tree, points, *, lenient, threads, progress))]
pub(crate) fn contains<'py>(
    py: Python<'py>,
    tree: &Tree,
    points: Floats<'py>,
    lenient: bool,
    threads: Option<i64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyArray1<bool>>> {
    let points = Points::new(points.rows("points")?, "points", lenient);
    let job = Job::new(threads, progress)?;
    let answer = for_points!(tree, scene => {
        let block = |points: &[[f64; 3]], inside: &mut [bool]| scene.contains_each(points, inside);
        run(py, &job, points.len(), |control| each_block(&points, control, block))
    });
    answer.map(|inside| inside.into_pyarray(py))
}

/// How far each point is from the surface; negative inside. NaN where nobody can say.
#[pyfunction]
#[pyo3(signature = (tree, points, *, is_double, lenient, threads, progress))]
pub(crate) fn signed_distance<'py>(
    py: Python<'py>,
    tree: &Tree,
    points: Floats<'py>,
    is_double: bool,
    lenient: bool,
    threads: Option<i64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let points = Points::new(points.rows("points")?, "points", lenient);
    let job = Job::new(threads, progress)?;
    let answer = for_points!(tree, scene => {
        let one = |point| scene.signed_distance(point).unwrap_or(f64::NAN);
        run(py, &job, points.len(), |control| each_point(&points, control, one))
    });
    answer.map(|distances| floats(py, distances, is_double))
}

/// How often the surface winds around each point.
#[pyfunction]
#[pyo3(signature = (tree, points, *, is_double, lenient, threads, progress))]
pub(crate) fn winding_number<'py>(
    py: Python<'py>,
    tree: &Tree,
    points: Floats<'py>,
    is_double: bool,
    lenient: bool,
    threads: Option<i64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let points = Points::new(points.rows("points")?, "points", lenient);
    let job = Job::new(threads, progress)?;
    let answer = for_points!(tree, scene => {
        let one = |point| scene.winding_number(point);
        run(py, &job, points.len(), |control| each_point(&points, control, one))
    });
    answer.map(|numbers| floats(py, numbers, is_double))
}

/// The nearest point of the surface to each point.
#[pyfunction]
#[pyo3(signature = (tree, points, *, is_double, lenient, threads, progress))]
pub(crate) fn closest_point<'py>(
    py: Python<'py>,
    tree: &Tree,
    points: Floats<'py>,
    is_double: bool,
    lenient: bool,
    threads: Option<i64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Arrays<'py>> {
    let points = Points::new(points.rows("points")?, "points", lenient);
    let (job, places) = (Job::new(threads, progress)?, &tree.places);
    for_points!(tree, scene => if is_double {
        let work = |control: &_| nearest::closest_point::<f64, _>(scene, places, &points, control);
        run(py, &job, points.len(), work)?.into_arrays(py)
    } else {
        let work = |control: &_| nearest::closest_point::<f32, _>(scene, places, &points, control);
        run(py, &job, points.len(), work)?.into_arrays(py)
    })
}

/// Whether nothing is strictly between each point and another.
#[pyfunction]
#[pyo3(signature = (tree, points, others, *, lenient, threads, progress))]
pub(crate) fn visible<'py>(
    py: Python<'py>,
    tree: &Tree,
    points: Floats<'py>,
    others: Floats<'py>,
    lenient: bool,
    threads: Option<i64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyArray1<bool>>> {
    let from = Points::new(points.rows("a")?, "a", lenient);
    let to = Points::new(others.rows("b")?, "b", lenient);
    if from.len() != to.len() {
        return Err(ArgumentError::new_err("a, b: there are not as many points of both"));
    }
    let job = Job::new(threads, progress)?;
    let answer = for_points!(tree, scene => {
        run(py, &job, from.len(), |control| points::visible(scene, &from, &to, control))
    });
    answer.map(|seen| seen.into_pyarray(py))
}

/// How thick the material is behind places on triangles.
#[pyfunction]
#[pyo3(signature = (tree, primitive_id, geometry_id, u, v, *, side, is_double, threads, progress))]
#[expect(clippy::too_many_arguments, reason = "they are those of the package's own method")]
pub(crate) fn thickness<'py>(
    py: Python<'py>,
    tree: &Tree,
    primitive_id: PyReadonlyArray1<'py, i32>,
    geometry_id: PyReadonlyArray1<'py, i32>,
    u: PyReadonlyArray1<'py, f64>,
    v: PyReadonlyArray1<'py, f64>,
    side: &str,
    is_double: bool,
    threads: Option<i64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let side = match side {
        "front" => Side::Front,
        "back" => Side::Back,
        other => {
            return Err(argument("side", format!("give \"front\" or \"back\", not {other:?}")));
        }
    };
    let lengths = [geometry_id.len(), u.len(), v.len()];
    if lengths.iter().any(|&length| length != primitive_id.len()) {
        return Err(ArgumentError::new_err("primitive_id, geometry_id, u, v: differ in length"));
    }
    let (primitives, geometries) = (primitive_id.as_array(), geometry_id.as_array());
    let ids = primitives.iter().zip(geometries);
    let ids = ids.map(|(&primitive, &geometry)| tree.places.index(primitive, geometry)).collect();
    // Two weights below one.
    const ROUNDED: f64 = f32::EPSILON as f64;
    let at = Surface {
        ids,
        weights: [u.as_array(), v.as_array()],
        rounded: if is_double { 0.0 } else { ROUNDED },
    };
    let job = Job::new(threads, progress)?;
    let answer = for_points!(tree, scene => {
        run(py, &job, at.ids.len(), |control| points::thickness(scene, &at, side, control))
    });
    answer.map(|lengths| floats(py, lengths, is_double))
}

/// An array of f64, or of f32.
fn floats(py: Python<'_>, numbers: Vec<f64>, is_double: bool) -> Bound<'_, PyAny> {
    if is_double {
        return numbers.into_pyarray(py).into_any();
    }
    let numbers: Vec<f32> = numbers.iter().map(|&number| f32::of(number)).collect();
    numbers.into_pyarray(py).into_any()
}

/// Answers so many questions: a few at once.
fn run<R: Send>(
    py: Python<'_>,
    job: &Job,
    count: usize,
    work: impl FnOnce(&Control) -> PyResult<R> + Send,
) -> PyResult<R> {
    job.answer(py, (count, FEW), work)
}
