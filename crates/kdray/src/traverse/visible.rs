//! Whether anything lies between two points.

use super::LeafWalk;
use crate::exact::segment_crosses;
use crate::geometry::{Coordinate, Ray};
use crate::primitives::TriangleMesh;
use crate::tree::KdTree;

/// Whether no triangle of `mesh` crosses the open segment between two points, by exact comparison
/// ([`segment_crosses`]). False if a coordinate, or a difference of two, is not finite.
///
/// The ray that finds the leaves has a rounded direction. Each component errs by a relative 2^-53,
/// and so does the t of a plane, which the walk's slack of 2^-38 covers; a component is zero only
/// where the ends are the same.
pub fn is_visible<T: Coordinate>(
    tree: &KdTree<3>,
    mesh: &TriangleMesh<T>,
    from: [f64; 3],
    to: [f64; 3],
) -> bool {
    let ray = Ray::through(from, to).with_interval(0.0, 1.0);
    if ray.check().is_err() {
        return from == to && from.iter().all(|x| x.is_finite());
    }
    let mut walk = LeafWalk::over(tree, mesh, &ray, &mut ());
    while let Some(leaf) = walk.next_leaf(1.0, &mut ()) {
        let mut corners =
            leaf.primitives.iter().map(|&id| mesh.corners(id).map(|p| p.map(T::to_f64)));
        if corners.any(|corners| segment_crosses(from, to, corners)) {
            return false;
        }
    }
    true
}
