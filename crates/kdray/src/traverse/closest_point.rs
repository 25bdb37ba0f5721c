//! The nearest point of a mesh.

use super::vicinity::Vicinity;
use super::{CellWalk, wide};
use crate::geometry::Coordinate;
use crate::layout::WideTree;
use crate::primitives::{ClosestPoint, Primitives, TriangleMesh, closest_on_triangle};
use crate::tree::KdTree;

/// The point of `mesh` that is nearest to `point`; of several at the same distance, the one of the
/// smallest primitive id. `None` for an empty mesh, or a point that is not finite.
///
/// Goes by the wide tree, if there is one and the point is in its reach; else by the canonical one.
/// A triangle's distance does not depend on the tree, so the answer is the same.
pub fn closest_point<T: Coordinate>(
    tree: &KdTree<3>,
    wide: Option<&WideTree>,
    mesh: &TriangleMesh<T>,
    point: [f64; 3],
) -> Option<ClosestPoint> {
    if mesh.count() == 0 || !point.iter().all(|x| x.is_finite()) {
        return None;
    }
    let vicinity = Vicinity::new(tree, mesh, point);
    let by_wide = wide.and_then(|wide| wide::closest_point(wide, mesh, point, vicinity));
    if by_wide.is_some() {
        return by_wide;
    }
    let mut walk = CellWalk::new(tree, vicinity.point);
    let mut nearest: Option<ClosestPoint> = None;
    let mut limit = f64::INFINITY;
    while let Some(ids) = walk.next_leaf(limit) {
        for &id in ids {
            let found = closest_on_triangle(point, mesh.corners(id).map(|p| p.map(T::to_f64)), id);
            if nearest.is_none_or(|nearest| found.precedes(&nearest)) {
                limit = vicinity.limit(found.distance);
                nearest = Some(found);
            }
        }
    }
    nearest
}
