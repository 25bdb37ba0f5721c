//! Line segments in the plane: the 2-D counterpart of triangles.

use super::{Hit, HitRule, Intersect, Primitives, Side};
use crate::exact::{side_of_ray, turned_side_sign};
use crate::geometry::{Aabb, Ray, clipped_bounds};
use std::cmp::Ordering;
use thiserror::Error;

/// Segments from a to b, for teaching and for plans. Their sides are decided exactly.
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
            HitRule::Crossing => {
                let turned = (turned_side_sign(ray, a, signs.0), turned_side_sign(ray, b, signs.1));
                turned.0 != Ordering::Equal && turned.0 == turned.1.reverse() && signs.0 != signs.1
            }
        };
        if !hit {
            return;
        }
        // o + t d = a + u (b − a): with x the cross product, u = (d x a') / (d x a' − d x b') and
        // t = (a' x (b − a)) / (d x (b − a)).
        let mut den = side_b;
        den.subtract_all(&side_a);
        let u = -side_a.value().divided_by(den.value());
        let t = a_cross_edge(ray.origin, a, b).value().divided_by(den.value());
        let side = if den.sign() == Ordering::Greater { Side::Front } else { Side::Back };
        if t.is_finite() && ray.interval.contains(t) {
            report(Hit { t, primitive_id: id, u, v: 0.0, side });
        }
    }
}

/// a' x (b − a) = a' x b', with a' and b' relative to the ray's origin.
fn a_cross_edge(o: [f64; 2], a: [f64; 2], b: [f64; 2]) -> crate::exact::Accumulator {
    let mut sum = crate::exact::Accumulator::default();
    for (p, q) in [(a, b), (b, o), (o, a)] {
        sum.add([p[0], q[1], 1.0]);
        sum.subtract([p[1], q[0], 1.0]);
    }
    sum
}
