//! The nearest point, by the wide tree.

use super::rounding::ROUNDING;
use super::search::triangle;
use crate::geometry::Coordinate;
use crate::layout::{Link, STACK_SIZE, TriangleBlock, WideNode, WideTree};
use crate::primitives::{ClosestPoint, TriangleMesh, closest_on_triangle};
use crate::traverse::vicinity::Vicinity;
use arrayvec::ArrayVec;

/// A bound for the relative error of a squared distance in f32: a difference, a square and two sums,
/// at most 5 roundings; and room to spare.
const ERROR: f32 = 16.0 * ROUNDING;

/// The nearest point of the triangles in a wide tree that is not empty; of several at the same
/// distance, the one of the smallest primitive id. `None` if `point` is, in the tree, farther from zero
/// than its reach. `vicinity` is that of the point.
///
/// Distances from boxes, of nodes and around triangles, are reckoned in f32, in the tree's coordinates, and
/// only leave out what is surely farther; those of points decide, and are computed in f64, on the mesh.
pub(crate) fn closest_point<T: Coordinate>(
    tree: &WideTree,
    mesh: &TriangleMesh<T>,
    point: [f64; 3],
    vicinity: Vicinity,
) -> Option<ClosestPoint> {
    let mut search = Search::new(tree, mesh, point, vicinity)?;
    let mut waiting = ArrayVec::<(f32, Link), STACK_SIZE>::new();
    waiting.push((0.0, Link::ROOT));
    while let Some((squared, link)) = waiting.pop() {
        if squared > search.limit {
            continue;
        }
        if link.is_leaf() {
            (0..link.block_count()).for_each(|index| search.visit(tree.block(link, index)));
        } else {
            search.push_children(tree.node(link), &mut waiting);
        }
    }
    search.nearest
}

/// A point, and what was found so far.
struct Search<'a, T: 'static> {
    mesh: &'a TriangleMesh<T>,
    point: [f64; 3],
    vicinity: Vicinity,
    /// Between these the point surely is.
    low: [f32; 3],
    high: [f32; 3],
    nearest: Option<ClosestPoint>,
    /// What is farther, squared, cannot be the nearest.
    limit: f32,
}

impl<'a, T: Coordinate> Search<'a, T> {
    fn new(
        tree: &WideTree,
        mesh: &'a TriangleMesh<T>,
        point: [f64; 3],
        vicinity: Vicinity,
    ) -> Option<Self> {
        let (reach, in_tree) = (tree.reach(), vicinity.point);
        if in_tree.iter().any(|x| x.abs() > f64::from(reach)) {
            return None;
        }
        // The coordinate is rounded once, and once more with the margin; in a block those of f64
        // corners are, too.
        let margin = 4.0 * ROUNDING * reach;
        let (low, high) = (in_tree.map(|x| x as f32 - margin), in_tree.map(|x| x as f32 + margin));
        Some(Self { mesh, point, vicinity, low, high, nearest: None, limit: f32::MAX })
    }

    /// Puts the children that may hold the nearest point on the stack, the nearest on top.
    #[inline]
    fn push_children(&self, node: &WideNode, waiting: &mut ArrayVec<(f32, Link), STACK_SIZE>) {
        let squared = self.squared_distances([0, 1, 2].map(|axis| *node.planes(axis)));
        let first = waiting.len();
        for (place, &squared) in squared.iter().enumerate() {
            if squared <= self.limit {
                waiting.push((squared, Link::from_bits(node.links()[place])));
            }
        }
        waiting[first..].sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
    }

    /// Computes the nearest points of those triangles of a block whose boxes are near enough.
    #[inline]
    fn visit(&mut self, block: &TriangleBlock) {
        let boxes = [0, 1, 2].map(|axis| {
            let [a, b, c] = [0, 1, 2].map(|corner| block.corner(corner, axis));
            let low = std::array::from_fn(|lane| a[lane].min(b[lane]).min(c[lane]));
            let high = std::array::from_fn(|lane| a[lane].max(b[lane]).max(c[lane]));
            [low, high]
        });
        let squared = self.squared_distances(boxes);
        for (lane, &squared) in squared.iter().enumerate() {
            // A lane without triangle is NaN.
            if squared <= self.limit && !boxes[0][0][lane].is_nan() {
                self.test(block, lane);
            }
        }
    }

    fn test(&mut self, block: &TriangleBlock, lane: usize) {
        let corners = triangle(self.mesh, block, lane).map(|p| p.map(T::to_f64));
        // In a tree file that was not verified they may be anything.
        if !corners.as_flattened().iter().all(|x| x.is_finite()) {
            return;
        }
        let found = closest_on_triangle(self.point, corners, block.id(lane));
        if self.nearest.is_none_or(|nearest| found.precedes(&nearest)) {
            let limit = self.vicinity.limit(found.distance);
            self.limit = ((limit * limit) as f32 * (1.0 + ERROR)).min(f32::MAX);
            self.nearest = Some(found);
        }
    }

    /// Bounds that the squared distances of eight boxes are not below, but for [`ERROR`], which the
    /// limit allows for. Infinite, or above the largest limit, where there is no box.
    #[inline]
    fn squared_distances(&self, boxes: [[[f32; 8]; 2]; 3]) -> [f32; 8] {
        let mut sum = [0.0; 8];
        for (axis, [low, high]) in boxes.iter().enumerate() {
            for lane in 0..8 {
                let below = low[lane] - self.high[axis];
                let above = self.low[axis] - high[lane];
                let gap = below.max(above).max(0.0);
                sum[lane] += gap * gap;
            }
        }
        sum
    }
}
