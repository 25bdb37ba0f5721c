//! The nearest point of the mesh to each point.

use crate::cast::Found;
use crate::columns::Real;
use crate::job::{Control, each_part};
use crate::mesh::rows;
use crate::points::{BLOCK, Points};
use crate::tree::{Place, Places};
use kdray::{ClosestPoint, Hit, Precision, Scene, Side};
use numpy::IntoPyArray;
use pyo3::{Bound, IntoPyObject, PyAny, PyResult, Python};

/// The numbers of many nearest points.
#[derive(Debug)]
pub(crate) struct ClosestPoints<F> {
    point: Vec<[F; 3]>,
    numbers: Vec<Numbers<F>>,
}

/// What is told besides the point.
#[derive(Clone, Copy, Debug, Default)]
struct Numbers<F> {
    distance: F,
    u: F,
    v: F,
    primitive_id: i32,
    geometry_id: i32,
}

/// Room for the points and the numbers of some of them.
type Part<'a, F> = (&'a mut [[F; 3]], &'a mut [Numbers<F>]);

/// The same as Python has them: the points, distances, u, v, and the ids of triangles and geometries.
#[derive(IntoPyObject)]
pub(crate) struct Arrays<'py>(
    Bound<'py, PyAny>,
    Bound<'py, PyAny>,
    Bound<'py, PyAny>,
    Bound<'py, PyAny>,
    Bound<'py, PyAny>,
    Bound<'py, PyAny>,
);

pub(crate) fn closest_point<F: Real, T: Precision>(
    scene: &Scene<T>,
    places: &Places,
    points: &Points<'_>,
    control: &Control,
) -> PyResult<ClosestPoints<F>> {
    let count = points.len();
    let mut answers = ClosestPoints {
        point: vec![[F::default(); 3]; count],
        numbers: vec![Numbers::default(); count],
    };
    let blocks = answers.point.chunks_mut(BLOCK).zip(answers.numbers.chunks_mut(BLOCK));
    let parts = blocks.enumerate().collect();
    each_part(
        control,
        parts,
        Vec::new,
        |block, (index, (nearest, numbers)): (usize, Part<'_, F>)| {
            let first = index * BLOCK;
            points.read(first..first + nearest.len(), block)?;
            for ((&point, nearest), numbers) in block.iter().zip(&mut *nearest).zip(numbers) {
                (*nearest, *numbers) = told(scene.closest_point(point), places);
            }
            control.add(nearest.len());
            Ok(())
        },
    )?;
    Ok(answers)
}

/// What is told of an answer; of none that the point is NaN and infinitely far, on no triangle.
fn told<F: Real>(found: Option<ClosestPoint>, places: &Places) -> ([F; 3], Numbers<F>) {
    let Some(found) = found else {
        let distance = F::of(f64::INFINITY);
        let numbers = Numbers { distance, primitive_id: -1, geometry_id: -1, ..Numbers::default() };
        return ([F::of(f64::NAN); 3], numbers);
    };
    let Place { primitive_id, geometry_id, .. } = places.of(&as_hit(&found));
    let (distance, u, v) = (F::of(found.distance), F::of(found.u), F::of(found.v));
    (found.point.map(F::of), Numbers { distance, u, v, primitive_id, geometry_id })
}

/// A hit of the same triangle.
fn as_hit(found: &ClosestPoint) -> Found {
    let ClosestPoint { distance, primitive_id, u, v, .. } = *found;
    Hit { t: distance, primitive_id, u, v, side: Side::Front }.into()
}

impl<F: Real> ClosestPoints<F> {
    /// Gives the numbers to Python.
    pub(crate) fn into_arrays(self, py: Python<'_>) -> PyResult<Arrays<'_>> {
        let floats = |number: fn(&Numbers<F>) -> F| {
            let column: Vec<F> = self.numbers.iter().map(number).collect();
            column.into_pyarray(py).into_any()
        };
        let ids = |id: fn(&Numbers<F>) -> i32| {
            let column: Vec<i32> = self.numbers.iter().map(id).collect();
            column.into_pyarray(py).into_any()
        };
        Ok(Arrays(
            rows(py, &self.point)?,
            floats(|it| it.distance),
            floats(|it| it.u),
            floats(|it| it.v),
            ids(|it| it.primitive_id),
            ids(|it| it.geometry_id),
        ))
    }
}
