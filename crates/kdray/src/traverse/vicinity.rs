//! What distances from a point are in a tree.

use crate::geometry::{Coordinate, TreeSpace};
use crate::primitives::{DISTANCE_ERROR, TriangleMesh};
use crate::tree::KdTree;

/// A point of a mesh as the tree over it sees it, and what a distance from there is in the tree.
///
/// Two things round. The distance from a triangle may be computed too small, see [`DISTANCE_ERROR`]. And the
/// point is moved on its way into the tree; so are the triangles, but for that their boxes are wider
/// ([`TreeSpace`]): each point of a triangle, put into the tree without rounding, is in a cell that lists it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vicinity {
    /// The point in the tree's coordinates; infinite if it is too far from there.
    pub(crate) point: [f64; 3],
    /// How long the mesh's unit is in the tree.
    scale: f64,
    /// By how much, in the tree, a distance may be more than what was computed.
    slack: f64,
}

impl Vicinity {
    /// That of `point`, whose coordinates are finite.
    pub(crate) fn new<T: Coordinate>(
        tree: &KdTree<3>,
        mesh: &TriangleMesh<T>,
        point: [f64; 3],
    ) -> Self {
        /// The digits that distances lose to underflow, in the smallest f64.
        const UNDERFLOW: f64 = 8.0;
        let space = mesh.tree_space();
        let (point, scale) = (space.point(point), space.scale());
        let slack = DISTANCE_ERROR * farthest_corner(tree, point)
            + TreeSpace::point_error(point)
            + UNDERFLOW * f64::from_bits(1) * scale;
        Self { point, scale, slack }
    }

    /// What no triangle is beyond, in the tree, whose distance is computed as `distance` or less.
    #[inline]
    pub(crate) fn limit(&self, distance: f64) -> f64 {
        // The largest f64 stands for all that are larger.
        if distance < f64::MAX { distance * self.scale + self.slack } else { f64::INFINITY }
    }
}

/// How far the farthest corner of the tree's box is, which no corner of a triangle is beyond.
fn farthest_corner(tree: &KdTree<3>, point: [f64; 3]) -> f64 {
    let bounds = tree.bounds();
    let reach = |k: usize| {
        let (min, max) = (f64::from(bounds.min[k]), f64::from(bounds.max[k]));
        (point[k] - min).abs().max((point[k] - max).abs())
    };
    let [x, y, z] = [reach(0), reach(1), reach(2)];
    (x * x + y * y + z * z).sqrt()
}
