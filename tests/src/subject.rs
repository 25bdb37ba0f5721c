//! Primitives that the matrix tests, with what is needed to aim at them and to know the truth.

use crate::oracle::{ExactHit, exact_segment_hit, exact_triangle_hit};
use kdray::primitives::{Balls, HitRule, Intersect, Segments};
use kdray::{Ray, TriangleMesh};

/// A kind of primitives that is compared with an oracle.
pub trait Subject<const K: usize>: Intersect<K> {
    /// Points of a primitive that are hard to hit: a triangle's corners, a segment's ends, the
    /// extreme points of a ball. The first three (in 2-D two) span the primitive.
    fn corners(&self, id: u32) -> Vec<[f64; K]>;

    /// The exact hits on the line of `ray`, or `None` if there is no oracle for such primitives.
    fn exact_hits(&self, ray: &Ray<K>, rule: HitRule) -> Option<Vec<ExactHit>>;
}

impl Subject<3> for TriangleMesh {
    fn corners(&self, id: u32) -> Vec<[f64; 3]> {
        TriangleMesh::corners(self, id).map(|p| p.map(f64::from)).to_vec()
    }

    fn exact_hits(&self, ray: &Ray<3>, rule: HitRule) -> Option<Vec<ExactHit>> {
        let ids = 0..self.triangles().len() as u32;
        let hit = |id| exact_triangle_hit(&TriangleMesh::corners(self, id), id, ray, rule);
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
