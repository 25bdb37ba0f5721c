//! The closest hit of each ray.

use crate::cast::{Cast, Room};
use crate::columns::{Columns, Part, Real};
use crate::job::{Control, each_part};
use crate::packet::common;
use crate::rays::Rays;
use crate::tree::{Tree, for_scene};
use pyo3::PyResult;

/// As many rays as are read and answered at a time: they and their hits fit the second-level cache.
pub(crate) const BLOCK: usize = 1024;

/// The same of rays that go in packets, which learn from each other how large they are best.
const PACKETS: usize = 8 * BLOCK;

/// How large blocks are, by what the first is like.
pub(crate) fn block_size(rays: &Rays<'_>) -> PyResult<usize> {
    let mut first = Vec::new();
    rays.read(0..rays.len().min(BLOCK), &mut first)?;
    Ok(if common(&first).is_some() { PACKETS } else { BLOCK })
}

pub(crate) fn closest_hit<F: Real>(
    tree: &Tree,
    rays: &Rays<'_>,
    control: &Control,
) -> PyResult<Columns<F>> {
    let mut columns = Columns::of_rays(rays.len(), &tree.places);
    let size = block_size(rays)?;
    let room = Room::default();
    let scratch = || (Vec::new(), room.beside());
    each_part(
        control,
        columns.parts(size, &tree.places),
        scratch,
        |(block, room), mut part: Part<'_, F>| {
            rays.read(part.range.clone(), block)?;
            for_scene!(tree, scene => scene.closest(block, room, &mut part));
            control.add(part.range.len());
            Ok(())
        },
    )?;
    Ok(columns)
}
