//! All hits of each ray, and how many they are.

use crate::block::BLOCK;
use crate::cast::Cast;
use crate::columns::{Columns, Real};
use crate::job::{Control, each_part};
use crate::rays::Rays;
use crate::room::Room;
use crate::tree::{Tree, for_scene};
use pyo3::PyResult;
use std::ops::Range;

/// So many blocks of rays are answered before their hits are put behind those of the blocks before, which happens
/// on one thread. What they take is what is there besides the answer.
const WAVE: usize = 256;

/// The hits of a block of rays.
struct Block<F> {
    rays: Range<usize>,
    /// How many hits each ray has.
    counts: Vec<usize>,
    hits: Columns<F>,
}

/// The hits, and where those of each ray begin; behind that, where the last end. No ray has more than `limit`.
pub(crate) fn all_hits<F: Real>(
    tree: &Tree,
    rays: &Rays<'_>,
    limit: usize,
    control: &Control,
) -> PyResult<(Vec<i64>, Columns<F>)> {
    let mut offsets = Vec::with_capacity(rays.len() + 1);
    offsets.push(0);
    let mut hits = Columns::new(&tree.places);
    for first in (0..rays.len()).step_by(WAVE * BLOCK) {
        let wave = first..rays.len().min(first + WAVE * BLOCK);
        for block in wave_of_hits(tree, rays, wave, limit, control)? {
            let mut end = hits.len();
            offsets.extend(block.counts.iter().map(|count| {
                end += count;
                end as i64
            }));
            hits.append(&block.hits);
        }
    }
    hits.shrink();
    Ok((offsets, hits))
}

fn wave_of_hits<F: Real>(
    tree: &Tree,
    rays: &Rays<'_>,
    wave: Range<usize>,
    limit: usize,
    control: &Control,
) -> PyResult<Vec<Block<F>>> {
    let empty = |first: usize| Block {
        rays: first..wave.end.min(first + BLOCK),
        counts: Vec::new(),
        hits: Columns::new(&tree.places),
    };
    let mut blocks: Vec<Block<F>> = wave.clone().step_by(BLOCK).map(empty).collect();
    let scratch = <(Vec<_>, Room)>::default;
    let parts = blocks.iter_mut().collect();
    each_part(control, parts, scratch, |(read, room), block: &mut Block<F>| {
        rays.read(block.rays.clone(), read)?;
        let Block { counts, hits, .. } = block;
        counts.resize(read.len(), 0);
        for_scene!(tree, scene => scene.all(read, limit, room, |index, hit| {
            counts[index] += 1;
            hits.push(&tree.places, &hit);
        }));
        control.add(read.len());
        Ok(())
    })?;
    Ok(blocks)
}

/// How many there are of each ray, or 2^31 - 1 if there are more.
pub(crate) fn count(tree: &Tree, rays: &Rays<'_>, control: &Control) -> PyResult<Vec<i32>> {
    let mut answers = vec![0; rays.len()];
    let parts = answers.chunks_mut(BLOCK).enumerate().collect();
    let scratch = <(Vec<_>, Vec<_>)>::default;
    each_part(control, parts, scratch, |(block, counts), (index, answers): (_, &mut [i32])| {
        let first = index * BLOCK;
        rays.read(first..first + answers.len(), block)?;
        counts.resize(answers.len(), 0);
        for_scene!(tree, scene => Cast::counts(scene, block, counts));
        answers
            .iter_mut()
            .zip(counts)
            .for_each(|(answer, count)| *answer = i32::try_from(*count).unwrap_or(i32::MAX));
        control.add(answers.len());
        Ok(())
    })?;
    Ok(answers)
}
