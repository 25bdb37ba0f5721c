//! The closest hit of each ray.

use crate::cast::Cast;
use crate::columns::{Columns, Part, Real};
use crate::job::{Control, each_part};
use crate::rays::{RayBlock, Rays};
use crate::tree::{Tree, for_scene};
use pyo3::PyResult;

/// As many rays as are read and answered at a time: they and their hits fit the second-level cache.
pub(crate) const BLOCK: usize = 1024;

pub(crate) fn closest_hit<F: Real>(
    tree: &Tree,
    rays: &Rays<'_>,
    control: &Control,
) -> PyResult<Columns<F>> {
    let mut columns = Columns::of_rays(rays.len(), &tree.places);
    let scratch = || (RayBlock::default(), Vec::new());
    each_part(control, columns.parts(BLOCK), scratch, |(block, hits), mut part: Part<'_, F>| {
        rays.read(part.range.clone(), block)?;
        for_scene!(tree, scene => scene.closest(&block.rays, hits, |index, found| {
            part.set(index, &tree.places, found.as_ref());
        }));
        control.add(part.range.len());
        Ok(())
    })?;
    Ok(columns)
}
