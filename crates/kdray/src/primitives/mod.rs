//! What a ray can hit, and all that the build and the traversal know of it.

mod ball;
mod closest_point;
mod closure;
mod hit;
mod hit_arrays;
mod mesh;
mod range;
mod segments;
mod solid_angle;
pub(crate) mod triangle;

pub use ball::{BallError, Balls};
pub(crate) use closest_point::DISTANCE_ERROR;
pub use closest_point::{ClosestPoint, closest_on_triangle};
pub use closure::Closure;
pub use hit::{Hit, HitRule, Side};
pub use hit_arrays::HitArrays;
pub use mesh::{MeshError, TriangleMesh};
pub(crate) use range::in_range;
pub use segments::{SegmentError, Segments};
pub use solid_angle::solid_angle;
pub use triangle::intersect_triangle;

use crate::geometry::{Aabb, Ray};

/// All that the build and the tree know of primitives in K dimensions: how many there are, and
/// where. A primitive's id is its index, from zero.
pub trait Primitives<const K: usize>: Sync {
    /// How many primitives there are: fewer than 2^32, of which a build refuses 2^30 and more.
    fn count(&self) -> usize;

    /// The primitive's bounding box, in finite coordinates.
    fn bounds(&self, id: u32) -> Aabb<K>;

    /// The bounding box of the primitive's part in the closed `cell`, never smaller than the true
    /// one; `None` only if no part lies there. The default is the shared part of the two boxes; a
    /// tighter answer makes a better tree.
    fn clipped_bounds(&self, id: u32, cell: &Aabb<K>) -> Option<Aabb<K>> {
        let shared = self.bounds(id).intersection(cell);
        (!shared.is_empty()).then_some(shared)
    }

    /// The bounding boxes of the primitive's parts in the two closed boxes into which the plane at
    /// `position` perpendicular to `axis` cuts `cell`, each as [`clipped_bounds`] says it. The
    /// default asks that twice; an answer that does the common work once makes builds faster.
    ///
    /// [`clipped_bounds`]: Self::clipped_bounds
    fn split_bounds(
        &self,
        id: u32,
        cell: &Aabb<K>,
        axis: usize,
        position: f32,
    ) -> [Option<Aabb<K>>; 2] {
        let (below, above) = cell.split(axis, position);
        [below, above].map(|cell| self.clipped_bounds(id, &cell))
    }

    /// The ray as the tree sees it, at the same t. The default is the ray as it is; primitives whose
    /// coordinates a tree cannot hold answer otherwise, and may answer `None` for a ray whose numbers would
    /// not fit: it is taken to meet everything.
    ///
    /// All boxes are to hold what lies in them as the tree sees it, what rounding does to the ray
    /// included, up to a relative error of 2^-50 in t.
    #[inline]
    fn ray_in_tree(&self, ray: &Ray<K>) -> Option<Ray<K>> {
        Some(*ray)
    }
}

/// Primitives that rays can be tested against.
pub trait Intersect<const K: usize>: Primitives<K> {
    /// Gives `report` each hit of `ray` on one primitive, in any order: those of t in
    /// `ray.interval` that count by `rule`. The t of a hit must depend on nothing but the ray's
    /// origin and direction and the primitive, and must lie within the primitive's bounds up to a
    /// relative error of 2^-39 in t.
    fn intersect(&self, id: u32, ray: &Ray<K>, rule: HitRule, report: &mut impl FnMut(Hit));
}
