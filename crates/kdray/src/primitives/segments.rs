//! Line segments in the plane: the 2-D counterpart of triangles.

use super::{Hit, HitRule, Intersect, Primitives, Side};
use crate::exact::{cross_component, moved_side_sign, side_of_ray};
use crate::geometry::{Aabb, Ray, clipped_bounds};
use std::cmp::Ordering;
use thiserror::Error;

/// Segments from a to b, for teaching and for plans. A touch is a meeting in one point; a ray
/// along a segment misses it.
///
/// All is decided and computed without rounding, and there is no filter: that is slow, and simple.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Segments {
    segments: Vec<[[f32; 2]; 2]>,
}

/// Why a list of segments cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("segment {0} has an end that is not finite; mend or drop it")]
pub struct SegmentError(pub usize);

impl Segments {
    /// Segments of the given ends.
    ///
    /// # Errors
    /// The first segment with an end that is not finite.
    pub fn new(segments: Vec<[[f32; 2]; 2]>) -> Result<Self, SegmentError> {
        match segments.iter().position(|ends| !ends.iter().flatten().all(|x| x.is_finite())) {
            Some(index) => Err(SegmentError(index)),
            None => Ok(Self { segments }),
        }
    }

    /// The two ends of each segment.
    pub fn ends(&self) -> &[[[f32; 2]; 2]] {
        &self.segments
    }
}

impl Primitives<2> for Segments {
    fn count(&self) -> usize {
        self.segments.len()
    }

    fn bounds(&self, id: u32) -> Aabb<2> {
        Aabb::of_points(self.segments[id as usize])
    }

    fn clipped_bounds(&self, id: u32, cell: &Aabb<2>) -> Option<Aabb<2>> {
        clipped_bounds(&self.segments[id as usize], cell)
    }
}

impl Intersect<2> for Segments {
    fn intersect(&self, id: u32, ray: &Ray<2>, rule: HitRule, report: &mut impl FnMut(Hit)) {
        let [a, b] = self.segments[id as usize].map(|end| end.map(f64::from));
        let (side_a, side_b) = (side_of_ray(ray, a), side_of_ray(ray, b));
        let signs = (side_a.sign(), side_b.sign());
        let hit = match rule {
            HitRule::Touching => signs.0 != signs.1,
            HitRule::Crossing => moved_side_sign(ray, signs.0) != moved_side_sign(ray, signs.1),
        };
        if !hit {
            return;
        }
        // o + t d = a + u (b − a): with x the cross product, u = (d x a') / (d x a' − d x b') and
        // t = (a' x (b − a)) / (d x (b − a)), where a' x (b − a) = a' x b'.
        let mut den = side_b;
        den.subtract_all(&side_a);
        let u = -side_a.value().divided_by(den.value());
        let t = cross_component(ray.origin, a, b, (0, 1)).value().divided_by(den.value());
        let side = if den.sign() == Ordering::Greater { Side::Front } else { Side::Back };
        if t.is_finite() && ray.interval.contains(t) {
            report(Hit { t, primitive_id: id, u, v: 0.0, side });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hits(ends: [[f32; 2]; 2], ray: &Ray<2>, rule: HitRule) -> Vec<Hit> {
        let mut hits = Vec::new();
        let segments = Segments::new(vec![ends]).unwrap();
        segments.intersect(0, ray, rule, &mut |hit| hits.push(hit));
        hits
    }

    #[test]
    fn a_ray_meets_a_segment_at_its_share() {
        let ray = Ray::new([0.0, 1.0], [2.0, 0.0]);
        for rule in [HitRule::Touching, HitRule::Crossing] {
            let found = hits([[4.0, 0.0], [4.0, 4.0]], &ray, rule);
            assert_eq!((found.len(), found[0].t, found[0].u), (1, 2.0, 0.25));
            assert_eq!(found[0].side, Side::Front, "the left of the segment");
            assert_eq!(hits([[4.0, 4.0], [4.0, 0.0]], &ray, rule)[0].side, Side::Back);
            assert!(hits([[4.0, 2.0], [4.0, 4.0]], &ray, rule).is_empty());
            assert!(hits([[3.0, 1.0], [4.0, 1.0]], &ray, rule).is_empty(), "along the ray");
        }
    }

    #[test]
    fn a_corner_is_touched_twice_and_crossed_once_or_not_at_all() {
        for d in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [1.0, 1.0], [-3.0, 1.0]] {
            let corner = [d[0] as f32 * 2.0, d[1] as f32 * 2.0];
            let side = [-corner[1], corner[0]];
            let ray = Ray::new([0.0, 0.0], d);
            let count = |ends: [[f32; 2]; 2], rule| hits(ends, &ray, rule).len();
            let (p, q) = (
                [corner[0] + side[0], corner[1] + side[1]],
                [corner[0] - side[0], corner[1] - side[1]],
            );
            assert_eq!(count([p, corner], HitRule::Touching), 1);
            assert_eq!(count([corner, q], HitRule::Touching), 1);
            let through =
                count([p, corner], HitRule::Crossing) + count([corner, q], HitRule::Crossing);
            assert_eq!(through, 1, "{d:?}");
            // Another end on the side of p.
            let r = [p[0] + corner[0], p[1] + corner[1]];
            let bounce =
                count([p, corner], HitRule::Crossing) + count([corner, r], HitRule::Crossing);
            assert_eq!(bounce % 2, 0, "{d:?}");
        }
    }
}
