//! All hits of each ray, and how many they are.

use crate::cast::Cast;
use crate::closest_hit::BLOCK;
use crate::columns::{Columns, Real};
use crate::job::{Control, each_part};
use crate::rays::{RayBlock, Rays};
use crate::tree::{Tree, for_scene};
use pyo3::PyResult;

/// The hits, and where those of each ray begin; behind that, where the last end. No ray has more than `limit`.
pub(crate) fn all_hits<F: Real>(
    tree: &Tree,
    rays: &Rays<'_>,
    limit: usize,
    control: &Control,
) -> PyResult<(Vec<i64>, Columns<F>)> {
    let starts = (0..rays.len()).step_by(BLOCK);
    let mut blocks: Vec<_> =
        starts.map(|first| (first, Vec::new(), Columns::new(&tree.places))).collect();
    let scratch = || (RayBlock::default(), Vec::new());
    let parts = blocks.iter_mut().collect();
    each_part(
        control,
        parts,
        scratch,
        |(block, hits), (first, ends, columns): &mut (usize, Vec<usize>, Columns<F>)| {
            rays.read(*first..rays.len().min(*first + BLOCK), block)?;
            for ray in &block.rays {
                let most = columns.len().saturating_add(limit);
                for_scene!(tree, scene => scene.all(ray, hits, |found| {
                    if columns.len() < most {
                        columns.push(&tree.places, &found);
                    }
                }));
                ends.push(columns.len());
            }
            control.add(block.rays.len());
            Ok(())
        },
    )?;
    let mut offsets = Vec::with_capacity(rays.len() + 1);
    offsets.push(0);
    let mut before = 0;
    for (_, ends, columns) in &blocks {
        offsets.extend(ends.iter().map(|end| (before + end) as i64));
        before += columns.len();
    }
    let columns = blocks.into_iter().map(|(_, _, columns)| columns);
    Ok((offsets, Columns::joined(columns.collect())))
}

/// How many there are of each ray: fewer than 2^31.
pub(crate) fn count(tree: &Tree, rays: &Rays<'_>, control: &Control) -> PyResult<Vec<i32>> {
    let mut answers = vec![0; rays.len()];
    let parts = answers.chunks_mut(BLOCK).enumerate().collect();
    let scratch = || (RayBlock::default(), Vec::new());
    each_part(control, parts, scratch, |(block, counts), (index, answers): (_, &mut [i32])| {
        let first = index * BLOCK;
        rays.read(first..first + answers.len(), block)?;
        counts.resize(answers.len(), 0);
        for_scene!(tree, scene => Cast::counts(scene, &block.rays, counts));
        answers.iter_mut().zip(counts).for_each(|(answer, count)| *answer = *count as i32);
        control.add(answers.len());
        Ok(())
    })?;
    Ok(answers)
}
