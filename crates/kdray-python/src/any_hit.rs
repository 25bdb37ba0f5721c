//! Whether each ray hits anything.

use crate::block::block_size;
use crate::cast::Cast;
use crate::job::{Control, each_part};
use crate::rays::Rays;
use crate::room::Room;
use crate::tree::{Tree, for_scene};
use pyo3::PyResult;

pub(crate) fn any_hit(tree: &Tree, rays: &Rays<'_>, control: &Control) -> PyResult<Vec<bool>> {
    let mut found = vec![false; rays.len()];
    let size = block_size(tree, rays)?;
    let parts = found.chunks_mut(size).enumerate().collect();
    let room = Room::default();
    let scratch = || (Vec::new(), room.beside());
    each_part(control, parts, scratch, |(block, room), (index, found): (_, &mut [bool])| {
        let first = index * size;
        rays.read(first..first + found.len(), block)?;
        for_scene!(tree, scene => scene.any(block, room, found));
        control.add(found.len());
        Ok(())
    })?;
    Ok(found)
}
