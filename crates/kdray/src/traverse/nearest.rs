//! The nearest point of a mesh.

use super::{CellWalk, wide};
use crate::layout::WideTree;
use crate::primitives::{
    ClosestPoint, DISTANCE_ERROR, FARTHEST, Primitives, TriangleMesh, closest_on_triangle,
};
use crate::tree::KdTree;

/// The point of `mesh` that is nearest to `point`; of several at the same distance, the one of the
/// smallest primitive id. `None` for an empty mesh, or a point that is not finite.
///
/// Goes by the wide tree, if there is one and the point is in its reach; else by the canonical one.
/// A triangle's distance does not depend on the tree, so the answer is the same.
pub fn closest_point(
    tree: &KdTree<3>,
    wide: Option<&WideTree>,
    mesh: &TriangleMesh,
    point: [f64; 3],
) -> Option<ClosestPoint> {
    if mesh.count() == 0 || !point.iter().all(|x| x.is_finite()) {
        return None;
    }
    let on_triangle =
        |id| closest_on_triangle(point, mesh.corners(id).map(|p| p.map(f64::from)), id);
    if point.iter().any(|x| x.abs() > FARTHEST) {
        // All triangles are at the same distance.
        return Some(on_triangle(0));
    }
    // How much smaller than the true one a triangle's distance may be.
    let slack = DISTANCE_ERROR * farthest_corner(tree, point);
    let by_wide = wide.and_then(|wide| wide::closest_point(wide, point, slack));
    if by_wide.is_some() {
        return by_wide;
    }
    let mut walk = CellWalk::new(tree, point);
    let mut nearest: Option<ClosestPoint> = None;
    let mut limit = f64::INFINITY;
    while let Some(ids) = walk.next_leaf(limit) {
        for &id in ids {
            let found = on_triangle(id);
            if nearest.is_none_or(|nearest| found.precedes(&nearest)) {
                limit = found.distance + slack;
                nearest = Some(found);
            }
        }
    }
    nearest
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
