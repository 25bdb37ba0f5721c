//! The closest hit of each ray.

use crate::block::block_size;
use crate::cast::Cast;
use crate::columns::{Columns, Part, Real};
use crate::job::{Control, each_part};
use crate::rays::Rays;
use crate::room::Room;
use crate::tree::{Tree, for_scene};
use pyo3::PyResult;

pub(crate) fn closest_hit<F: Real>(
    tree: &Tree,
    rays: &Rays<'_>,
    control: &Control,
) -> PyResult<Columns<F>> {
    let mut columns = Columns::of_rays(rays.len(), &tree.places);
    let size = block_size(tree, rays)?;
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
