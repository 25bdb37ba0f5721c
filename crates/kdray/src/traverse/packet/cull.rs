//! Primitives against a frustum, before any ray is tested.
//!
//! A triangle is missed by all rays if it lies beyond one of the planes of the frustum, or if the
//! edge functions at the four corner rays tell: an edge function is linear in the slopes, so between
//! corner rays that pass an edge on one side no ray passes it on the other (Boulos, Wald & Shirley
//! 2006). All of it is done with error bounds, so that no hit is lost that the exact test finds.

use super::bundle::rounding;
use super::frustum::{Frustum, Line};
use crate::geometry::{Aabb, Common};
use crate::primitives::{Balls, Intersect, TriangleMesh};

/// Primitives of which a frustum can tell that none of its rays hits them.
///
/// Packets see rays as they are: primitives that override [`ray_in_tree`] would lose hits, and must not implement
/// this.
///
/// [`ray_in_tree`]: crate::primitives::Primitives::ray_in_tree
pub trait Cull: Intersect<3> {
    /// Whether surely no ray in the frustum hits the primitive. The default looks at its bounding
    /// box; a tighter answer saves tests.
    fn misses(&self, id: u32, frustum: &Frustum) -> bool {
        frustum.misses_box(&self.bounds(id))
    }
}

impl Cull for Balls<3> {}

impl Cull for TriangleMesh {
    fn misses(&self, id: u32, frustum: &Frustum) -> bool {
        frustum.misses_triangle(&self.corners(id))
    }
}

/// A bound for the error of an edge function, in parts of |d| · |p| · |q|: some twenty roundings,
/// and what parallel rays differ in slope, with room to spare.
const EDGE_ERROR: f64 = 1024.0 * f64::EPSILON;

/// A point as the frustum sees it: across on two axes, then the depth.
type Local = [f64; 3];

impl Frustum {
    /// Whether surely no ray in the frustum meets the box.
    pub fn misses_box(&self, aabb: &Aabb<3>) -> bool {
        let corner = |bits: usize| {
            let upper = |k: usize| bits >> k & 1 == 1;
            let side = |k: usize| if upper(k) { aabb.max[k] } else { aabb.min[k] };
            self.local([side(0), side(1), side(2)])
        };
        self.has_beyond_a_plane(&[0, 1, 2, 3, 4, 5, 6, 7].map(corner))
    }

    /// Whether surely no ray in the frustum hits the triangle.
    pub fn misses_triangle(&self, corners: &[[f32; 3]; 3]) -> bool {
        let corners = corners.map(|corner| self.local(corner));
        self.has_beyond_a_plane(&corners) || self.passes_beside(&corners)
    }

    /// A point as seen from the base.
    fn local(&self, p: [f32; 3]) -> Local {
        let from_base = |k: usize| f64::from(p[k]) - self.bundle.base[k];
        let [i, j] = self.bundle.sides();
        [from_base(i), from_base(j), self.bundle.sign * from_base(self.bundle.axis)]
    }

    /// Whether all points lie behind the base, or all beyond the same side plane.
    fn has_beyond_a_plane(&self, points: &[Local]) -> bool {
        let beyond = |line: Line, side: usize, sign: f64| {
            points.iter().all(|p| {
                let way = line.slope * p[2];
                let beyond = sign * (p[side] - line.offset - way);
                beyond > rounding(p[side], way) + rounding(line.offset, 0.0)
            })
        };
        let sides = self.bundle.sides();
        points.iter().all(|p| p[2] < 0.0)
            || (0..2).any(|side| {
                let axis = sides[side];
                beyond(self.low[axis], side, -1.0) || beyond(self.high[axis], side, 1.0)
            })
    }

    /// Whether the corner rays tell that no ray between them hits: a hit needs edge functions that
    /// share a sign, which is that of their sum.
    fn passes_beside(&self, [a, b, c]: &[Local; 3]) -> bool {
        let edges = [self.edge(b, c), self.edge(c, a), self.edge(a, b)];
        let sum = edges[0].plus(&edges[1]).plus(&edges[2]);
        let is_left = edges.iter().any(AtCorners::is_positive);
        let is_right = edges.iter().any(AtCorners::is_negative);
        is_left && (is_right || sum.is_negative()) || is_right && sum.is_positive()
    }

    /// The edge function d · ((p − o) x (q − o)) at the corner rays.
    fn edge(&self, p: &Local, q: &Local) -> AtCorners {
        let [i, j] = self.bundle.sides();
        let (low, high) = (self.low, self.high);
        let corners = [(low[i], low[j]), (high[i], low[j]), (high[i], high[j]), (low[i], high[j])];
        let mut values = AtCorners { values: [0.0; 4], error: 0.0 };
        for (value, (x, y)) in values.values.iter_mut().zip(corners) {
            let from = |p: &Local| [p[0] - x.offset, p[1] - y.offset, p[2]];
            let (p, q, d) = (from(p), from(q), [x.slope, y.slope, 1.0]);
            *value = determinant(&d, &p, &q);
            let reach = |p: &Local, o: f64| p.iter().fold(o, |m, x| m.max(x.abs()));
            let offset = x.offset.abs().max(y.offset.abs());
            let (p, q) = (reach(&p, offset), reach(&q, offset));
            let speed = d.iter().map(|d| d.abs()).sum::<f64>();
            let error = speed * (EDGE_ERROR * p * q + 4.0 * self.spread() * (p + q));
            values.error = values.error.max(error + f64::MIN_POSITIVE);
        }
        values
    }

    /// How far rays that should meet in the apex pass it: offsets and slopes then vary
    /// independently, while a corner ray joins one of each.
    fn spread(&self) -> f64 {
        if let Common::Direction(_) = self.bundle.common {
            return 0.0;
        }
        let spread = |axis: usize| self.high[axis].offset - self.low[axis].offset;
        self.bundle.sides().map(spread).into_iter().fold(0.0, f64::max)
    }
}

/// A function at the four corner rays, and how far rounding may have moved it.
struct AtCorners {
    values: [f64; 4],
    error: f64,
}

impl AtCorners {
    fn plus(&self, other: &Self) -> Self {
        let values = std::array::from_fn(|i| self.values[i] + other.values[i]);
        Self { values, error: self.error + other.error }
    }

    fn is_positive(&self) -> bool {
        self.values.iter().all(|&value| value > self.error)
    }

    fn is_negative(&self) -> bool {
        self.values.iter().all(|&value| value < -self.error)
    }
}

/// d · (p x q).
fn determinant(d: &Local, p: &Local, q: &Local) -> f64 {
    let cross = |i: usize, j: usize| p[i] * q[j] - p[j] * q[i];
    d[0] * cross(1, 2) + d[1] * cross(2, 0) + d[2] * cross(0, 1)
}
