//! Whether each ray hits anything.

use crate::cast::Cast;
use crate::closest_hit::BLOCK;
use crate::job::{Control, each_part};
use crate::rays::{RayBlock, Rays};
use crate::tree::{Tree, for_scene};
use pyo3::PyResult;

pub(crate) fn any_hit(tree: &Tree, rays: &Rays<'_>, control: &Control) -> PyResult<Vec<bool>> {
    let mut found = vec![false; rays.len()];
    let parts = found.chunks_mut(BLOCK).enumerate().collect();
    each_part(control, parts, RayBlock::default, |block, (index, found): (_, &mut [bool])| {
        let first = index * BLOCK;
        rays.read(first..first + found.len(), block)?;
        for_scene!(tree, scene => scene.any(&block.rays, found));
        control.add(found.len());
        Ok(())
    })?;
    Ok(found)
}
