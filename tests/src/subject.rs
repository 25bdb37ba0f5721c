//! Primitives that the matrix tests, with what is needed to aim at them and to know the truth.

use crate::meshes;
use crate::oracle::{ExactHit, exact_segment_hit, exact_triangle_hit};
use kdray::primitives::{Balls, HitRule, Intersect, Segments};
use kdray::{Aabb, Coordinate, Ray, TriangleMesh};

/// A kind of primitives that is compared with an oracle.
pub trait Subject<const K: usize>: Intersect<K> {
    /// Points of a primitive that are hard to hit: a triangle's corners, a segment's ends, the
    /// extreme points of a ball. The first three (in 2-D two) span the primitive.
    fn corners(&self, id: u32) -> Vec<[f64; K]>;

    /// The least and the greatest coordinate of the primitives on each axis; if there are none, the greatest
    /// is below the least.
    fn extent(&self) -> ([f64; K], [f64; K]) {
        let ids = 0..self.count() as u32;
        let bounds = ids.fold(Aabb::EMPTY, |bounds, id| bounds.union(&self.bounds(id)));
        (bounds.min.map(f64::from), bounds.max.map(f64::from))
    }

    /// Where a split plane of a tree over the primitives lies.
    fn plane(&self, _axis: usize, split: f32) -> f64 {
        f64::from(split)
    }

    /// A number next to x of so few digits that its difference to a corner's coordinate is not rounded,
    /// if the corners' have few as well. `largest` is the largest of all coordinates.
    fn rounded(x: f64, _largest: f64) -> f64 {
        f64::from(x.clamp(f32::MIN.into(), f32::MAX.into()) as f32)
    }

    /// The exact hits on the line of `ray`, or `None` if there is no oracle for such primitives.
    fn exact_hits(&self, ray: &Ray<K>, rule: HitRule) -> Option<Vec<ExactHit>>;
}

impl<T: Coordinate> Subject<3> for TriangleMesh<T> {
    fn corners(&self, id: u32) -> Vec<[f64; 3]> {
        Self::corners(self, id).map(|p| p.map(T::to_f64)).to_vec()
    }

    fn extent(&self) -> ([f64; 3], [f64; 3]) {
        let corners = (0..self.triangles().len() as u32).flat_map(|id| Self::corners(self, id));
        let (mut min, mut max) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for (k, x) in corners.flat_map(|p| p.map(T::to_f64).into_iter().enumerate()) {
            (min[k], max[k]) = (min[k].min(x), max[k].max(x));
        }
        (min, max)
    }

    fn plane(&self, axis: usize, split: f32) -> f64 {
        let space = self.tree_space();
        f64::from(split) / space.scale() + space.center()[axis]
    }

    fn rounded(x: f64, largest: f64) -> f64 {
        if T::FITS_TREE {
            return f64::from(x.clamp(f32::MIN.into(), f32::MAX.into()) as f32);
        }
        meshes::snapped(x, largest)
    }

    fn exact_hits(&self, ray: &Ray<3>, rule: HitRule) -> Option<Vec<ExactHit>> {
        let ids = 0..self.triangles().len() as u32;
        let hit = |id| exact_triangle_hit(&Self::corners(self, id), id, ray, rule);
        Some(ids.filter_map(hit).collect())
    }
}

impl Subject<2> for Segments {
    fn corners(&self, id: u32) -> Vec<[f64; 2]> {
        self.ends()[id as usize].map(|p| p.map(f64::from)).to_vec()
    }

    fn exact_hits(&self, ray: &Ray<2>, rule: HitRule) -> Option<Vec<ExactHit>> {
        let ends = self.ends().iter().enumerate();
        Some(ends.filter_map(|(id, ends)| exact_segment_hit(ends, id as u32, ray, rule)).collect())
    }
}

impl<const K: usize> Subject<K> for Balls<K> {
    /// The points of the ball that touch the tightest box around it.
    fn corners(&self, id: u32) -> Vec<[f64; K]> {
        let (center, radius) = self.centers_and_radii()[id as usize];
        let pole = |axis: usize, radius: f32| {
            let mut pole = center.map(f64::from);
            pole[axis] += f64::from(radius);
            pole
        };
        (0..K).flat_map(|k| [pole(k, -radius), pole(k, radius)]).collect()
    }

    fn exact_hits(&self, _ray: &Ray<K>, _rule: HitRule) -> Option<Vec<ExactHit>> {
        None
    }
}
