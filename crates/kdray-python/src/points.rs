//! Questions about points.

use crate::error::{ArgumentError, LENIENT, UnsupportedError};
use crate::job::{Control, each_part};
use crate::rows::Rows;
use kdray::{Precision, Scene, Side};
use numpy::ndarray::ArrayView1;
use pyo3::{PyErr, PyResult};
use std::ops::Range;

/// As many points as are read and answered at a time.
pub(crate) const BLOCK: usize = 256;

/// The same where they are answered in turns.
const BLOCK_IN_TURNS: usize = 1024;

/// Points of a caller.
#[derive(Debug)]
pub(crate) struct Points<'a> {
    rows: Rows<'a, 3>,
    /// What the caller calls them.
    name: &'static str,
    /// Whether points that are not finite are answered, as those that are nowhere, instead of refused.
    lenient: bool,
}

impl<'a> Points<'a> {
    pub(crate) fn new(rows: Rows<'a, 3>, name: &'static str, lenient: bool) -> Self {
        Self { rows, name, lenient }
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.rows.len()
    }

    /// Replaces `points` by those of `range`.
    ///
    /// # Errors
    /// The first that is not finite.
    pub(crate) fn read(&self, range: Range<usize>, points: &mut Vec<[f64; 3]>) -> PyResult<()> {
        let first = range.start;
        self.rows.read(range, points);
        let is_bad = |point: &[f64; 3]| !point.iter().all(|x| x.is_finite());
        match points.iter().position(is_bad).filter(|_| !self.lenient) {
            Some(index) => Err(ArgumentError::new_err(format!(
                "{}: that of index {} is not finite; with {LENIENT} such points are nowhere",
                self.name,
                first + index
            ))),
            None => Ok(()),
        }
    }
}

/// Calls for the scene of a tree, if it is one that answers questions about points.
macro_rules! for_points {
    ($tree:expr, $scene:ident => $answer:expr) => {
        match &$tree.kind {
            $crate::tree::Kind::F32($scene) => $answer,
            $crate::tree::Kind::F64($scene) => $answer,
            $crate::tree::Kind::Copies32(_) | $crate::tree::Kind::Copies64(_) => {
                Err($crate::points::unsupported())
            }
        }
    };
}
pub(crate) use for_points;

/// That a scene does not answer questions about points.
pub(crate) fn unsupported() -> PyErr {
    let reason = "points and tree files are not supported for scenes with instances; \
                  add the triangles of each copy instead";
    UnsupportedError::new_err(reason)
}

/// The answer for each point.
pub(crate) fn each_point<A: Copy + Default + Send>(
    points: &Points<'_>,
    control: &Control,
    answer: impl Fn([f64; 3]) -> A + Send + Sync,
) -> PyResult<Vec<A>> {
    by_blocks(points, BLOCK, control, |points, answers| {
        answers.iter_mut().zip(points).for_each(|(place, &point)| *place = answer(point));
    })
}

/// The same, where `answer` takes many points at once, and in turns.
pub(crate) fn each_block<A: Copy + Default + Send>(
    points: &Points<'_>,
    control: &Control,
    answer: impl Fn(&[[f64; 3]], &mut [A]) + Send + Sync,
) -> PyResult<Vec<A>> {
    by_blocks(points, BLOCK_IN_TURNS, control, answer)
}

fn by_blocks<A: Copy + Default + Send>(
    points: &Points<'_>,
    size: usize,
    control: &Control,
    answer: impl Fn(&[[f64; 3]], &mut [A]) + Send + Sync,
) -> PyResult<Vec<A>> {
    let mut answers = vec![A::default(); points.len()];
    let parts = answers.chunks_mut(size).enumerate().collect();
    each_part(control, parts, Vec::new, |block, (index, answers): (usize, &mut [A])| {
        let first = index * size;
        points.read(first..first + answers.len(), block)?;
        answer(block, answers);
        control.add(answers.len());
        Ok(())
    })?;
    Ok(answers)
}

/// Whether nothing is between each point and that of the same index.
pub(crate) fn visible<T: Precision>(
    scene: &Scene<T>,
    from: &Points<'_>,
    to: &Points<'_>,
    control: &Control,
) -> PyResult<Vec<bool>> {
    let mut answers = vec![false; from.len()];
    let parts = answers.chunks_mut(BLOCK).enumerate().collect();
    let scratch = || (Vec::new(), Vec::new());
    each_part(control, parts, scratch, |(ends, starts), (index, answers): (_, &mut [bool])| {
        let range = index * BLOCK..index * BLOCK + answers.len();
        from.read(range.clone(), starts)?;
        to.read(range, ends)?;
        let pairs = starts.iter().zip(&*ends);
        answers.iter_mut().zip(pairs).for_each(|(place, (&a, &b))| *place = scene.visible(a, b));
        control.add(answers.len());
        Ok(())
    })?;
    Ok(answers)
}

/// Places on triangles: their ids among all, and the weights u and v.
#[derive(Debug)]
pub(crate) struct Surface<'a> {
    pub(crate) ids: Vec<Option<u32>>,
    pub(crate) weights: [ArrayView1<'a, f64>; 2],
    /// What the sum of the weights may be off by, because they were rounded to f32: places that are as near to the edge
    /// opposite the first corner lie on it.
    pub(crate) rounded: f64,
}

/// How thick the material behind each place is; NaN where nothing is behind it, or there is no such triangle.
pub(crate) fn thickness<T: Precision>(
    scene: &Scene<T>,
    at: &Surface<'_>,
    side: Side,
    control: &Control,
) -> PyResult<Vec<f64>> {
    let mut answers = vec![0.0; at.ids.len()];
    let parts = answers.chunks_mut(BLOCK).enumerate().collect();
    let one = |index: usize| {
        let [u, v] = at.weights;
        let (u, v) = (*u.get(index)?, *v.get(index)?);
        // On the edge of the second and third corners, as far as one can tell; not in one of them, if it is on another edge.
        let (first, inside) = (1.0 - u - v, u.min(v) > at.rounded);
        let is_on_edge = first.abs() < at.rounded && (first < 0.0 || inside);
        scene.thickness(at.ids[index]?, u, if is_on_edge { 1.0 - u } else { v }, side)
    };
    each_part(
        control,
        parts,
        || (),
        |(), (index, answers): (usize, &mut [f64])| {
            let places = answers.iter_mut().enumerate();
            places.for_each(|(i, place)| *place = one(index * BLOCK + i).unwrap_or(f64::NAN));
            control.add(answers.len());
            Ok(())
        },
    )?;
    Ok(answers)
}
