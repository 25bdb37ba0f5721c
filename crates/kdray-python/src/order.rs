//! The rays of a block in an order in which neighbours are neighbours in space, as packets want them: pictures come
//! line by line, and scans in any order.

use glam::{DVec3, Vec3};
use kdray::Ray;
use kdray::geometry::Common;

/// So many rays are meant to share a cell: a small packet.
const CELL: usize = 64;

/// Where most rays are is found out by each of so many; odd, for pictures have even lines.
const SAMPLE: usize = 13;

/// Rays are ahead of a point if they are less than 84 degrees from the mean of all: a square of a cosine.
const LEAST_AHEAD: f32 = 0.01;

/// Puts rays into the cells of a grid, row by row and to and fro, so that each cell borders on the next.
#[derive(Debug, Default)]
pub(crate) struct Order {
    /// Where the rays are on a plane.
    places: Vec<[f32; 2]>,
    cells: Vec<u32>,
    /// Where the rays of each cell begin; in the end, where they end.
    starts: Vec<u32>,
    /// The indices of the rays.
    indices: Vec<u32>,
}

impl Order {
    /// The indices of rays that share something, in their new order.
    pub(crate) fn of(&mut self, common: Common, rays: &[Ray]) -> &[u32] {
        places(common, rays, &mut self.places);
        let grid = Grid::over(&self.places);
        self.cells.clear();
        self.cells.extend(self.places.iter().map(|&place| grid.cell(place)));
        self.sort(grid.columns * grid.rows);
        &self.indices
    }

    /// Counts what is in each cell, and puts the rays there in the order in which they came.
    fn sort(&mut self, cell_count: u32) {
        self.starts.clear();
        self.starts.resize(cell_count as usize, 0);
        self.cells.iter().for_each(|&cell| self.starts[cell as usize] += 1);
        let mut next = 0;
        for start in &mut self.starts {
            next += std::mem::replace(start, next);
        }
        self.indices.resize(self.cells.len(), 0);
        for (index, &cell) in self.cells.iter().enumerate() {
            let start = &mut self.starts[cell as usize];
            self.indices[*start as usize] = index as u32;
            *start += 1;
        }
    }
}

/// Where rays pass a plane: of those from one point before them, of parallel ones across their direction. Rays from one
/// point to more than a half-space have places on an octahedron that is folded open. NaN stays NaN.
fn places(common: Common, rays: &[Ray], places: &mut Vec<[f32; 2]>) {
    places.clear();
    if let Common::Direction(direction) = common {
        let [_, a, b] = frame(direction.into());
        let place = |ray: &Ray| [a, b].map(|axis| axis.dot(ray.origin.into()) as f32);
        return places.extend(rays.iter().map(place));
    }
    let directions = || rays.iter().map(|ray| to_f32(ray.direction.into()));
    let sum: Vec3 = directions().step_by(SAMPLE).filter(|direction| direction.is_finite()).sum();
    let [ahead, a, b] = frame(sum.into()).map(to_f32);
    let mut are_ahead = true;
    places.extend(directions().map(|direction| {
        let depth = direction.dot(ahead);
        are_ahead &= is_ahead(depth, direction);
        let scale = 1.0 / depth;
        [a.dot(direction) * scale, b.dot(direction) * scale]
    }));
    if !are_ahead {
        places.clear();
        places.extend(directions().map(on_octahedron));
    }
}

/// Whether a direction is well ahead, by how far it leads there. One that is not finite is nowhere: it says nothing
/// about the others.
fn is_ahead(depth: f32, direction: Vec3) -> bool {
    let is_ahead = depth > 0.0 && depth * depth > LEAST_AHEAD * direction.length_squared();
    is_ahead || !direction.is_finite()
}

fn to_f32(vector: DVec3) -> Vec3 {
    vector.as_vec3()
}

/// A direction, and two at right angles to it.
fn frame(direction: DVec3) -> [DVec3; 3] {
    let ahead = direction.try_normalize().unwrap_or(DVec3::Z);
    let (a, b) = ahead.any_orthonormal_pair();
    [ahead, a, b]
}

fn on_octahedron(direction: Vec3) -> [f32; 2] {
    let Vec3 { x, y, z } = direction / direction.abs().element_sum();
    if z >= 0.0 { [x, y] } else { [(1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y)] }
}

/// Squares over the places, in rows along the axis on which they spread most, as the lines of a picture do. It is made
/// by a sample; those outside are put into the nearest square of a row.
struct Grid {
    /// The axis, as a cosine and a sine.
    along: [f32; 2],
    min: [f32; 2],
    /// Cells for a unit of length.
    scale: f32,
    columns: u32,
    rows: u32,
}

impl Grid {
    fn over(places: &[[f32; 2]]) -> Self {
        let along = longest_axis(places);
        let mut min = [f32::INFINITY; 2];
        let mut max = [f32::NEG_INFINITY; 2];
        for place in sample(places) {
            let place = turned(along, place);
            for axis in 0..2 {
                min[axis] = min[axis].min(place[axis]);
                max[axis] = max[axis].max(place[axis]);
            }
        }
        let [width, height] = [max[0] - min[0], max[1] - min[1]];
        let cells = places.len().div_ceil(CELL) as f32;
        // A grid that is narrower than one of its cells is a line of them.
        let side = (width * height / cells).sqrt().max(width.max(height) / cells);
        // No spread, one so small that its inverse is too large, and one too large make a single cell.
        let scale = Some(1.0 / side).filter(|scale| scale.is_finite()).unwrap_or(0.0);
        let [columns, rows] = [width, height].map(|length| (length * scale) as u32 + 1);
        Self { along, min, scale, columns, rows }
    }

    fn cell(&self, place: [f32; 2]) -> u32 {
        let [x, y] = turned(self.along, place);
        // What is below zero becomes zero, and so does NaN.
        let at = |x: f32, min: f32, count: u32| (((x - min) * self.scale) as u32).min(count - 1);
        let (column, row) = (at(x, self.min[0], self.columns), at(y, self.min[1], self.rows));
        let column = if row % 2 == 0 { column } else { self.columns - 1 - column };
        row * self.columns + column
    }
}

/// The axis along which places spread most, as a cosine and a sine.
fn longest_axis(places: &[[f32; 2]]) -> [f32; 2] {
    let count = sample(places).count() as f32;
    let mean = sample(places).fold([0.0; 2], |[a, b], [x, y]| [a + x / count, b + y / count]);
    let [xx, xy, yy] = sample(places).fold([0.0_f32; 3], |[xx, xy, yy], [x, y]| {
        let (x, y) = (x - mean[0], y - mean[1]);
        [xx + x * x, xy + x * y, yy + y * y]
    });
    let (sin, cos) = ((2.0 * xy).atan2(xx - yy) / 2.0).sin_cos();
    [cos, sin]
}

/// Some of the places, those that are finite.
fn sample(places: &[[f32; 2]]) -> impl Iterator<Item = [f32; 2]> {
    let sample = places.iter().step_by(SAMPLE).copied();
    sample.filter(|place| place.iter().all(|x| x.is_finite()))
}

fn turned([cos, sin]: [f32; 2], [x, y]: [f32; 2]) -> [f32; 2] {
    [cos * x + sin * y, cos * y - sin * x]
}
