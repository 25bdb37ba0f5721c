//! What the queries about points share.

use crate::layout::Clusters;
use crate::primitives::Closure;
use std::sync::OnceLock;

/// What is made of a mesh when a query about points first needs it.
#[derive(Debug, Default)]
pub(super) struct ForPoints {
    pub(super) closure: OnceLock<Closure>,
    pub(super) clusters: OnceLock<Clusters>,
}

/// Puts the answer for each point in its place.
///
/// # Panics
/// If the slices differ in length.
pub(super) fn each<A>(points: &[[f64; 3]], answers: &mut [A], answer: impl Fn([f64; 3]) -> A) {
    assert_eq!(points.len(), answers.len(), "as many answers as points");
    points.iter().zip(answers).for_each(|(&point, place)| *place = answer(point));
}

/// The same on all threads of the current rayon pool.
///
/// # Panics
/// If the slices differ in length.
#[cfg(feature = "rayon")]
pub(super) fn par_each<A: Send>(
    points: &[[f64; 3]],
    answers: &mut [A],
    answer: impl Fn([f64; 3]) -> A + Sync,
) {
    use rayon::prelude::*;
    /// Enough to be worth a thread's while.
    const RUN: usize = 64;
    assert_eq!(points.len(), answers.len(), "as many answers as points");
    let places = points.par_iter().zip(answers).with_min_len(RUN);
    places.for_each(|(&point, place)| *place = answer(point));
}

/// Hands points to all threads of the current rayon pool, with the room for their answers.
///
/// # Panics
/// If the slices differ in length.
#[cfg(feature = "rayon")]
pub(super) fn par_chunks<A: Send>(
    points: &[[f64; 3]],
    answers: &mut [A],
    answer: impl Fn(&[[f64; 3]], &mut [A]) + Sync,
) {
    use rayon::prelude::*;
    const CHUNK: usize = 1024;
    assert_eq!(points.len(), answers.len(), "as many answers as points");
    let chunks = points.par_chunks(CHUNK).zip(answers.par_chunks_mut(CHUNK));
    chunks.for_each(|(points, answers)| answer(points, answers));
}
