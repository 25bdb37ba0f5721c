//! Arrays of a caller, read where they lie.

use crate::error::argument;
use numpy::ndarray::{ArrayView2, ArrayViewD, Axis, Ix2};
use numpy::{PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::{FromPyObject, PyResult};
use std::ops::Range;

/// An array of floats.
#[derive(FromPyObject)]
pub(crate) enum Floats<'py> {
    #[pyo3(transparent)]
    F32(PyReadonlyArrayDyn<'py, f32>),
    #[pyo3(transparent)]
    F64(PyReadonlyArrayDyn<'py, f64>),
}

/// The rows of an array, whatever its strides: all that is in its last dimension. Those of a plain array are
/// read as they lie in memory.
#[derive(Clone, Debug)]
pub(crate) enum Rows<'a, const N: usize> {
    F32(ArrayViewD<'a, f32>),
    F64(ArrayViewD<'a, f64>),
}

impl Floats<'_> {
    /// The rows of `N` numbers; `name` is what the caller calls the array.
    pub(crate) fn rows<const N: usize>(&self, name: &str) -> PyResult<Rows<'_, N>> {
        let (shape, is_aligned) = match self {
            Self::F32(array) => (array.shape(), array.is_aligned()),
            Self::F64(array) => (array.shape(), array.is_aligned()),
        };
        if shape.last() != Some(&N) {
            return Err(argument(
                name,
                format!("give an array of shape (..., {N}), not {shape:?}"),
            ));
        }
        if !is_aligned {
            return Err(argument(name, "give an array that is aligned in memory"));
        }
        Ok(match self {
            Self::F32(array) => Rows::F32(with_rows(array.as_array())),
            Self::F64(array) => Rows::F64(with_rows(array.as_array())),
        })
    }
}

/// The same array with two dimensions or more.
fn with_rows<T>(view: ArrayViewD<'_, T>) -> ArrayViewD<'_, T> {
    if view.ndim() == 1 { view.insert_axis(Axis(0)) } else { view }
}

impl<const N: usize> Rows<'_, N> {
    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::F32(view) => view.len() / N,
            Self::F64(view) => view.len() / N,
        }
    }

    /// Replaces `rows` by those of `range`, in the order of C.
    pub(crate) fn read(&self, range: Range<usize>, rows: &mut Vec<[f64; N]>) {
        rows.clear();
        match self {
            Self::F32(view) => read(view, range, rows),
            Self::F64(view) => read(view, range, rows),
        }
    }
}

/// Reads run by run: as many rows as follow each other in the last dimension but one.
fn read<T: Copy + Into<f64>, const N: usize>(
    view: &ArrayViewD<'_, T>,
    range: Range<usize>,
    rows: &mut Vec<[f64; N]>,
) {
    let length = view.shape()[view.ndim() - 2];
    let mut next = range.start;
    while next < range.end {
        let Some(run) = run(view.view(), next / length) else { return };
        let first = next % length;
        let end = length.min(first + range.end - next);
        match run.to_slice() {
            Some(numbers) => {
                let (numbers, _) = numbers.as_chunks::<N>();
                rows.extend(numbers[first..end].iter().map(|row| row.map(Into::into)));
            }
            None => rows.extend((first..end).map(|i| std::array::from_fn(|k| run[[i, k]].into()))),
        }
        next += end - first;
    }
}

/// The run of that index.
fn run<T>(mut view: ArrayViewD<'_, T>, mut index: usize) -> Option<ArrayView2<'_, T>> {
    while view.ndim() > 2 {
        let others: usize = view.shape()[1..view.ndim() - 2].iter().product();
        view = view.index_axis_move(Axis(0), index / others);
        index %= others;
    }
    view.into_dimensionality::<Ix2>().ok()
}
