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

    /// The row that all of them are, where they are one in memory: of arrays that were broadcast.
    pub(crate) fn same(&self) -> Option<[f64; N]> {
        match self {
            Self::F32(view) => same(view),
            Self::F64(view) => same(view),
        }
    }

    /// Gives `take` the rows of `range`, in the order of C.
    #[inline]
    pub(crate) fn each(&self, range: Range<usize>, take: impl FnMut([f64; N])) {
        match self {
            Self::F32(view) => each(view, range, take),
            Self::F64(view) => each(view, range, take),
        }
    }

    /// Replaces `rows` by those of `range`.
    pub(crate) fn read(&self, range: Range<usize>, rows: &mut Vec<[f64; N]>) {
        rows.clear();
        rows.reserve(range.len());
        self.each(range, |row| rows.push(row));
    }
}

/// The only row in memory, if there is one.
fn same<T: Copy + Into<f64>, const N: usize>(view: &ArrayViewD<'_, T>) -> Option<[f64; N]> {
    let axes = view.shape().iter().zip(view.strides()).rev().skip(1);
    let is_one = !view.is_empty() && axes.into_iter().all(|(&len, &step)| len == 1 || step == 0);
    let mut first = None;
    if is_one {
        each(view, 0..1, |row| first = Some(row));
    }
    first
}

/// Goes run by run, unless all rows follow each other: as many rows as there are in the last dimension but one.
#[inline]
fn each<T: Copy + Into<f64>, const N: usize>(
    view: &ArrayViewD<'_, T>,
    range: Range<usize>,
    mut take: impl FnMut([f64; N]),
) {
    if let Some(numbers) = view.to_slice() {
        return each_of_slice(numbers, range, take);
    }
    let length = view.shape()[view.ndim() - 2];
    let mut next = range.start;
    while next < range.end {
        let Some(run) = run(view.view(), next / length) else { return };
        let first = next % length;
        let end = length.min(first + range.end - next);
        match run.to_slice() {
            Some(numbers) => each_of_slice(numbers, first..end, &mut take),
            None => {
                let rows = run.slice_axis_move(Axis(0), (first..end).into());
                rows.outer_iter().for_each(|row| take(std::array::from_fn(|k| row[k].into())));
            }
        }
        next += end - first;
    }
}

#[inline]
fn each_of_slice<T: Copy + Into<f64>, const N: usize>(
    numbers: &[T],
    range: Range<usize>,
    mut take: impl FnMut([f64; N]),
) {
    let (rows, _) = numbers.as_chunks::<N>();
    rows[range].iter().for_each(|row| take(row.map(Into::into)));
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
