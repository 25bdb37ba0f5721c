//! The bounds of a convex polygon's part inside a box ("perfect splits", Havran 2000, §4.3).

use super::coordinate::{round_down, round_up};
use super::{Aabb, Coordinate};
use arrayvec::ArrayVec;

/// Room for a polygon cut by the 2·K planes of a cell, each of which adds one vertex at most.
const MOST_VERTICES: usize = 12;

/// A polygon while it is being cut.
type Polygon<const K: usize> = ArrayVec<Vertex<K>, MOST_VERTICES>;

/// A vertex of the polygon while it is being cut.
#[derive(Clone, Copy)]
struct Vertex<const K: usize> {
    position: [f64; K],
    /// How far a coordinate may be from the true one: for the polygon's own vertices as the caller says,
    /// which is zero for f32.
    error: f64,
}

/// The smallest box, rounded outward, of the part of a convex polygon (or segment) that lies in
/// the closed `cell`; `None` if no part does.
///
/// Sutherland and Hodgman's clipping, one plane after the other, in f64. The result never leaves
/// out a true point: cuts are made at the cell's planes moved outward by a pad far above what
/// rounding can do to a cut vertex, and cut vertices count with the pad as their error. The
/// polygon's own vertices count exactly, so a polygon that lies in an axis-aligned plane stays
/// flat.
///
/// # Panics
/// If the polygon has more than 12 − 2·K vertices: 8 in the plane, 6 in space.
pub fn clipped_bounds<const K: usize>(polygon: &[[f32; K]], cell: &Aabb<K>) -> Option<Aabb<K>> {
    clipped_bounds_of(polygon, 0.0, cell)
}

/// [`clipped_bounds`] of a polygon whose coordinates may be off by `error`, and so may the points that
/// are looked for: the box holds each point of the cell that is so near the polygon. Zero for f32.
pub(crate) fn clipped_bounds_of<T: Coordinate, const K: usize>(
    polygon: &[[T; K]],
    error: f64,
    cell: &Aabb<K>,
) -> Option<Aabb<K>> {
    let pad = pad(&bounds_of(polygon, error), cell, error);
    bounds_within((polygon, error), cell, Faces { outward: pad, error: pad })
}

/// A box that each box around the same part holds, up to the last place of a coordinate, whatever cuts and
/// paddings it comes from. Of what the cell's faces cut off, a little more is left out: what reaches less than 2^-39
/// of the largest coordinate into the cell, and twice the error.
pub(crate) fn inner_bounds_of<T: Coordinate, const K: usize>(
    polygon: &[[T; K]],
    error: f64,
    cell: &Aabb<K>,
) -> Option<Aabb<K>> {
    let pad = pad(&bounds_of(polygon, error), cell, error);
    bounds_within((polygon, error), cell, Faces { outward: -pad, error })
}

/// The faces of a cell as they cut.
#[derive(Clone, Copy)]
struct Faces {
    /// How far outside of the cell they are.
    outward: f64,
    /// By how much what they cut is off.
    error: f64,
}

/// The box of what `faces` leave of a polygon, within the cell.
fn bounds_within<T: Coordinate, const K: usize>(
    (polygon, error): (&[[T; K]], f64),
    cell: &Aabb<K>,
    faces: Faces,
) -> Option<Aabb<K>> {
    assert!(polygon.len() + 2 * K <= MOST_VERTICES, "a polygon of {} vertices", polygon.len());
    let whole = bounds_of(polygon, error);
    let limit = whole.intersection(cell);
    if limit.is_empty() || limit == whole {
        return (!limit.is_empty()).then_some(limit);
    }
    let mut buffers: [Polygon<K>; 2] = [Polygon::new(), Polygon::new()];
    let part = clipped((polygon, error), &whole, cell, faces, &mut buffers);
    let bounds = part.iter().fold(Aabb::EMPTY, |bounds, v| bounds.union(&outward(v)));
    let bounds = bounds.intersection(&limit);
    (!bounds.is_empty()).then_some(bounds)
}

/// The box around all points that are so near the polygon.
pub(crate) fn bounds_of<T: Coordinate, const K: usize>(polygon: &[[T; K]], error: f64) -> Aabb<K> {
    let around =
        |p: &[T; K]| Aabb { min: p.map(|x| x.below(error)), max: p.map(|x| x.above(error)) };
    polygon.iter().fold(Aabb::EMPTY, |bounds, p| bounds.union(&around(p)))
}

/// The smallest boxes, rounded outward, of the parts of a convex polygon (or segment) that lie in
/// the two closed boxes into which the plane at `position` perpendicular to `axis` cuts `cell`:
/// what [`clipped_bounds`] says of each for less. The polygon is cut at the cell's
/// faces once for both, and not at all where it lies in the cell, which is the usual case; of the
/// last cut only the bounds are reckoned.
///
/// # Panics
/// As [`clipped_bounds`].
pub fn split_bounds<const K: usize>(
    polygon: &[[f32; K]],
    cell: &Aabb<K>,
    axis: usize,
    position: f32,
) -> [Option<Aabb<K>>; 2] {
    split_bounds_of(polygon, 0.0, cell, axis, position)
}

/// [`split_bounds`] of a polygon whose coordinates may be off by `error`: see [`clipped_bounds_of`].
pub(crate) fn split_bounds_of<T: Coordinate, const K: usize>(
    polygon: &[[T; K]],
    error: f64,
    cell: &Aabb<K>,
    axis: usize,
    position: f32,
) -> [Option<Aabb<K>>; 2] {
    assert!(polygon.len() + 2 * K <= MOST_VERTICES, "a polygon of {} vertices", polygon.len());
    let whole = bounds_of(polygon, error);
    let pad = pad(&whole, cell, error);
    let parts = if T::FITS_TREE && whole.intersection(cell) == whole {
        split_whole(polygon, axis, position, pad)
    } else {
        let mut buffers: [Polygon<K>; 2] = [Polygon::new(), Polygon::new()];
        let faces = Faces { outward: pad, error: pad };
        let part = clipped((polygon, error), &whole, cell, faces, &mut buffers);
        split_part(part, axis, position, pad)
    };
    let (below, above) = cell.split(axis, position);
    let within = |part: Aabb<K>, half: &Aabb<K>| {
        let bounds = part.intersection(&whole.intersection(half));
        (!bounds.is_empty()).then_some(bounds)
    };
    [within(parts[0], &below), within(parts[1], &above)]
}

/// The bounds of a polygon's parts below and above a plane.
///
/// Its vertices are exact, and so are the signs of their distances from the plane; a crossing of an
/// edge errs by far less than the pad.
#[inline]
fn split_whole<T: Coordinate, const K: usize>(
    polygon: &[[T; K]],
    axis: usize,
    position: f32,
    pad: f64,
) -> [Aabb<K>; 2] {
    let [mut below, mut above] = [Aabb::EMPTY; 2];
    let mut crossings = Extent::NONE;
    let plane = f64::from(position);
    let position = T::from_f32(position);
    let Some(mut from) = polygon.last() else { return [below, above] };
    for to in polygon {
        if to[axis] <= position {
            include(&mut below, to);
        }
        if to[axis] >= position {
            include(&mut above, to);
        }
        let is_crossing = from[axis] < position && to[axis] > position
            || from[axis] > position && to[axis] < position;
        if is_crossing {
            let (p, q) = (from.map(T::to_f64), to.map(T::to_f64));
            let share = (plane - p[axis]) / (q[axis] - p[axis]);
            let mut crossing: [f64; K] = std::array::from_fn(|k| p[k] + share * (q[k] - p[k]));
            crossing[axis] = plane;
            crossings.include(&crossing, pad);
        }
        from = to;
    }
    let crossings = crossings.rounded_outward();
    [below.union(&crossings), above.union(&crossings)]
}

/// The bounds of the parts below and above a plane of what is left of a polygon.
///
/// No true point is left out, for the reason given at [`clipped_bounds`]: each part is cut at the
/// plane moved outward by the pad. A vertex of the polygon so far errs by less than 2^-8 of the pad, besides
/// the error that the caller told of.
/// So one that truly lies on a part's side is kept; and on an edge that leaves the part, the computed
/// crossing with the moved plane lies beyond the true crossing with the plane itself.
#[inline]
fn split_part<const K: usize>(
    part: &Polygon<K>,
    axis: usize,
    position: f32,
    pad: f64,
) -> [Aabb<K>; 2] {
    let plane = f64::from(position);
    let below = Cut { axis, plane: plane + pad, side: -1.0 };
    let above = Cut { axis, plane: plane - pad, side: 1.0 };
    [bounds_beyond(part, &below, pad), bounds_beyond(part, &above, pad)]
}

/// Makes `bounds` hold a point, too.
#[inline]
fn include<T: Coordinate, const K: usize>(bounds: &mut Aabb<K>, point: &[T; K]) {
    for ((min, max), &x) in bounds.min.iter_mut().zip(&mut bounds.max).zip(point) {
        let x = x.below(0.0);
        *min = if x < *min { x } else { *min };
        *max = if x > *max { x } else { *max };
    }
}

/// A box in f64.
struct Extent<const K: usize> {
    min: [f64; K],
    max: [f64; K],
}

impl<const K: usize> Extent<K> {
    const NONE: Self = Self { min: [f64::INFINITY; K], max: [f64::NEG_INFINITY; K] };

    /// Makes it hold what is as near to a position as `error`, too.
    #[inline]
    fn include(&mut self, position: &[f64; K], error: f64) {
        for ((min, max), &x) in self.min.iter_mut().zip(&mut self.max).zip(position) {
            *min = if x - error < *min { x - error } else { *min };
            *max = if x + error > *max { x + error } else { *max };
        }
    }

    #[inline]
    fn rounded_outward(&self) -> Aabb<K> {
        Aabb { min: self.min.map(round_down), max: self.max.map(round_up) }
    }
}

/// The part of `polygon`, which `whole` bounds, that `faces` of `cell` leave.
fn clipped<'a, T: Coordinate, const K: usize>(
    (polygon, error): (&[[T; K]], f64),
    whole: &Aabb<K>,
    cell: &Aabb<K>,
    faces: Faces,
    buffers: &'a mut [Polygon<K>; 2],
) -> &'a Polygon<K> {
    // Each cut reads one of the buffers and writes the other.
    let [mut part, mut next] = buffers.each_mut();
    part.extend(polygon.iter().map(|&p| Vertex { position: p.map(T::to_f64), error }));
    for axis in 0..K {
        if whole.min[axis] < cell.min[axis] {
            let plane = f64::from(cell.min[axis]) - faces.outward;
            cut(part, next, &Cut { axis, plane, side: 1.0 }, faces.error);
            std::mem::swap(&mut part, &mut next);
        }
        if whole.max[axis] > cell.max[axis] {
            let plane = f64::from(cell.max[axis]) + faces.outward;
            cut(part, next, &Cut { axis, plane, side: -1.0 }, faces.error);
            std::mem::swap(&mut part, &mut next);
        }
    }
    part
}

/// 2^-40 of the largest coordinate: cutting six times in f64 errs by less than 2^-48 of it. And twice what
/// the polygon's vertices err by, so that half of the pad is for cutting.
fn pad<const K: usize>(whole: &Aabb<K>, cell: &Aabb<K>, error: f64) -> f64 {
    let mut largest = 0.0_f32;
    for axis in 0..K {
        let of_whole = whole.min[axis].abs().max(whole.max[axis].abs());
        let of_cell = cell.min[axis].abs().max(cell.max[axis].abs());
        largest = largest.max(of_whole.max(of_cell));
    }
    f64::from(largest) * (1.0 / (1u64 << 40) as f64) + 2.0 * error
}

/// A half-space: where `side · position[axis] ≥ side · plane`.
struct Cut {
    axis: usize,
    plane: f64,
    side: f64,
}

impl Cut {
    /// How far a vertex lies within.
    #[inline]
    fn depth<const K: usize>(&self, vertex: &Vertex<K>) -> f64 {
        self.side * (vertex.position[self.axis] - self.plane)
    }

    /// Where the plane meets the edge between vertices at depths `a` and `b`, of which one is
    /// negative and one is not.
    #[inline]
    fn crossing<const K: usize>(
        &self,
        (from, a): (&Vertex<K>, f64),
        (to, b): (&Vertex<K>, f64),
    ) -> [f64; K] {
        let share = a / (a - b);
        let mut position: [f64; K] =
            std::array::from_fn(|k| from.position[k] + share * (to.position[k] - from.position[k]));
        position[self.axis] = self.plane;
        position
    }
}

/// Makes `part` that of `polygon` within `cut`.
fn cut<const K: usize>(polygon: &Polygon<K>, part: &mut Polygon<K>, cut: &Cut, error: f64) {
    part.clear();
    let Some(mut from) = polygon.last() else { return };
    let mut a = cut.depth(from);
    for to in polygon {
        let b = cut.depth(to);
        if (a >= 0.0) != (b >= 0.0) {
            part.push(Vertex { position: cut.crossing((from, a), (to, b)), error });
        }
        if b >= 0.0 {
            part.push(*to);
        }
        (from, a) = (to, b);
    }
}

/// The bounds of what [`cut`] would leave.
#[inline]
fn bounds_beyond<const K: usize>(polygon: &Polygon<K>, cut: &Cut, error: f64) -> Aabb<K> {
    let mut extent = Extent::NONE;
    if let Some(mut from) = polygon.last() {
        let mut a = cut.depth(from);
        for to in polygon {
            let b = cut.depth(to);
            if (a >= 0.0) != (b >= 0.0) {
                extent.include(&cut.crossing((from, a), (to, b)), error);
            }
            if b >= 0.0 {
                extent.include(&to.position, to.error);
            }
            (from, a) = (to, b);
        }
    }
    extent.rounded_outward()
}

/// The box of one vertex and its error, rounded outward to f32.
fn outward<const K: usize>(vertex: &Vertex<K>) -> Aabb<K> {
    Aabb {
        min: vertex.position.map(|x| round_down(x - vertex.error)),
        max: vertex.position.map(|x| round_up(x + vertex.error)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    #[test]
    fn a_corner_cut_off_has_tight_bounds() {
        let cell = Aabb { min: [3.0, -1.0, -1.0], max: [9.0, 9.0, 9.0] };
        let bounds = clipped_bounds(&TRIANGLE, &cell).unwrap();
        assert_eq!(bounds.min, [3.0, 0.0, 0.0]);
        assert_eq!((bounds.max[0], bounds.max[2]), (4.0, 0.0));
        assert!(bounds.max[1] >= 1.0 && bounds.max[1] < 1.000_001);
    }

    #[test]
    fn a_cell_beside_the_slanted_edge_holds_nothing() {
        let cell = Aabb { min: [3.0, 3.0, -1.0], max: [4.0, 4.0, 1.0] };
        assert_eq!(clipped_bounds(&TRIANGLE, &cell), None);
    }

    #[test]
    fn touching_in_a_point_counts() {
        let corner = Aabb { min: [2.0, 2.0, 0.0], max: [5.0, 5.0, 1.0] };
        assert!(clipped_bounds(&TRIANGLE, &corner).is_some());
        let vertex = Aabb { min: [4.0, -1.0, -1.0], max: [5.0, 0.0, 0.0] };
        let bounds = clipped_bounds(&TRIANGLE, &vertex).unwrap();
        assert_eq!((bounds.min, bounds.max), ([4.0, 0.0, 0.0], [4.0, 0.0, 0.0]));
    }

    proptest! {
        #[test]
        fn splitting_gives_the_bounds_of_both_sides(
            corners in prop::array::uniform3(prop::array::uniform3(-2.0_f32..2.0)),
            snapped in any::<bool>(),
            axis in 0_usize..3,
            position in -0.9_f32..0.9,
            (u, v) in (0.0..1.0, 0.0..1.0),
        ) {
            let snap = |x: f32| if snapped { (2.0 * x).round() / 2.0 } else { x };
            let (corners, position) = (corners.map(|p| p.map(snap)), snap(position));
            let cell = Aabb { min: [-1.0; 3], max: [1.0; 3] };
            let (below, above) = cell.split(axis, position);
            let split = split_bounds(&corners, &cell, axis, position);
            let (u, v): (f64, f64) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let [a, b, c] = corners.map(|p| p.map(f64::from));
            let point = [0, 1, 2].map(|k| a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]));
            for (found, half) in split.into_iter().zip([below, above]) {
                if half.contains(point) {
                    let (min, max) = found.map(|f| (f.min, f.max)).expect("the point lies there");
                    let rounding = 1e-15;
                    prop_assert!((0..3).all(|k| f64::from(min[k]) <= point[k] + rounding));
                    prop_assert!((0..3).all(|k| f64::from(max[k]) >= point[k] - rounding));
                }
                // A part that only touches the half may be seen by one and not by the other.
                let apart = clipped_bounds(&corners, &half);
                if let (Some(found), Some(apart)) = (found, apart) {
                    let near = |a: f32, b: f32| (a - b).abs() <= 1e-6;
                    prop_assert!((0..3).all(|k| near(found.min[k], apart.min[k])));
                    prop_assert!((0..3).all(|k| near(found.max[k], apart.max[k])));
                }
            }
        }
    }

    proptest! {
        /// A point of the cell that is as near as the error to the triangle is in the bounds, and in those
        /// of the half that it lies in.
        #[test]
        fn what_is_near_is_within(
            corners in prop::array::uniform3(prop::array::uniform3(-2.0..2.0_f64)),
            off in prop::array::uniform3(-1.0..1.0_f64),
            error in prop::sample::select(vec![1e-14, 1e-9, 1e-3]),
            axis in 0_usize..3,
            position in -0.9_f32..0.9,
            (u, v, flat) in (0.0..1.0, 0.0..1.0, any::<bool>()),
        ) {
            let corners = corners.map(|[x, y, z]| if flat { [x, y, 0.3] } else { [x, y, z] });
            let (u, v): (f64, f64) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let [a, b, c] = corners;
            let cell = Aabb { min: [-1.0; 3], max: [1.0; 3] };
            // A little less than the error, for here the point is rounded as well.
            let point = [0, 1, 2].map(|k| {
                a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]) + 0.9 * error * off[k]
            });
            prop_assert!(bounds_of(&corners, error).contains(point));
            prop_assume!(cell.contains(point));
            let found = clipped_bounds_of(&corners, error, &cell);
            prop_assert!(found.is_some_and(|found| found.contains(point)), "{:?}", found);
            let (below, above) = cell.split(axis, position);
            let halves = split_bounds_of(&corners, error, &cell, axis, position);
            for (found, half) in halves.into_iter().zip([below, above]) {
                let is_in = found.is_some_and(|found| found.contains(point));
                prop_assert!(is_in || !half.contains(point), "{:?}", found);
                let apart = clipped_bounds_of(&corners, error, &half);
                let is_in = apart.is_some_and(|apart| apart.contains(point));
                prop_assert!(is_in || !half.contains(point), "{:?}", apart);
            }
        }
    }

    #[test]
    fn segments_are_polygons_of_two() {
        let cell = Aabb { min: [1.0, 0.0], max: [2.0, 9.0] };
        let bounds = clipped_bounds(&[[0.0, 0.0], [4.0, 8.0]], &cell).unwrap();
        assert!((bounds.min[1] - 2.0).abs() < 1e-5 && (bounds.max[1] - 4.0).abs() < 1e-5);
        assert_eq!((bounds.min[0], bounds.max[0]), (1.0, 2.0));
    }
}
