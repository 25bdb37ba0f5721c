//! Menger's sponge.

use super::assembly::Shape;
use glam::DVec3;

/// The sponge in the cube from −1 to 1 after `levels` cuts, without the faces between its cubes:
/// 2·(2·20^levels + 4·8^levels) triangles.
pub(super) fn menger_sponge(levels: u32) -> Shape {
    let size = 3_i64.pow(levels);
    let mut shape = Shape::default();
    let cells = (0..size * size * size).map(|i| [i % size, i / size % size, i / (size * size)]);
    for cell in cells.filter(|&cell| is_solid(cell, size)) {
        for axis in 0..3 {
            for step in [-1, 1] {
                let mut next = cell;
                next[axis] += step;
                if !is_solid(next, size) {
                    add_face(&mut shape, cell, size, axis, step);
                }
            }
        }
    }
    shape
}

/// Whether the cell is in the sponge: no digit to the base of three, at any place, is 1 in two of
/// its coordinates.
fn is_solid(mut cell: [i64; 3], size: i64) -> bool {
    if cell.iter().any(|&x| x < 0 || x >= size) {
        return false;
    }
    while cell != [0; 3] {
        if cell.iter().filter(|&&x| x % 3 == 1).count() >= 2 {
            return false;
        }
        cell = cell.map(|x| x / 3);
    }
    true
}

fn add_face(shape: &mut Shape, cell: [i64; 3], size: i64, axis: usize, step: i64) {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let corner = |du: i64, dv: i64| {
        let mut corner = cell;
        corner[axis] += i64::from(step > 0);
        corner[u] += du;
        corner[v] += dv;
        DVec3::from(corner.map(|x| 2.0 * x as f64 / size as f64 - 1.0))
    };
    // Seen from +axis, u to v runs counter-clockwise.
    let around =
        if step > 0 { [(0, 0), (1, 0), (1, 1), (0, 1)] } else { [(0, 0), (0, 1), (1, 1), (1, 0)] };
    shape.flat_quad(
        around.map(|(du, dv)| corner(du, dv)),
        around.map(|(du, dv)| [du as f64, dv as f64]),
    );
}

#[cfg(test)]
mod tests {
    use super::super::assembly::tests::assert_closed;
    use super::*;

    #[test]
    fn the_sponge_has_as_many_faces_as_it_should() {
        for levels in 0..3 {
            let shape = menger_sponge(levels);
            let faces = 2 * 20_usize.pow(levels) + 4 * 8_usize.pow(levels);
            assert_eq!(shape.triangles.len(), 2 * faces);
            assert_closed(&shape);
        }
    }
}
