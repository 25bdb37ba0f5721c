//! Where a ray meets a primitive.

use std::cmp::Ordering;

/// A point at which a ray meets a primitive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The ray's parameter: the point is origin + t · direction.
    pub t: f64,
    /// The index of the primitive, for a triangle mesh that of the triangle.
    pub primitive_id: u32,
    /// Barycentric weight of a triangle's second vertex b: the point is (1−u−v)·a + u·b + v·c. On
    /// a segment the share of the way from its first end; on a ball zero.
    pub u: f64,
    /// Barycentric weight of a triangle's third vertex c; zero for other primitives.
    pub v: f64,
    /// The side the ray came from.
    pub side: Side,
}

impl Hit {
    /// The order of hits along a ray: by t, and for equal t by primitive id.
    #[inline]
    pub fn precedes(&self, other: &Self) -> bool {
        (self.t, self.primitive_id) < (other.t, other.primitive_id)
    }

    /// The same order for sorting: ball hits so close that their t are equal are told apart by
    /// side, the front first.
    pub fn order(&self, other: &Self) -> Ordering {
        // Adding zero makes -0 and 0 one.
        let by_t = (self.t + 0.0).total_cmp(&(other.t + 0.0));
        by_t.then(self.primitive_id.cmp(&other.primitive_id)).then(self.side.cmp(&other.side))
    }
}

/// A side of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Side {
    /// The side that the geometric normal (b−a) x (c−a) points to: seen from here a triangle's
    /// vertices run counter-clockwise. The outside of a ball; the left of a segment.
    Front,
    /// The other side.
    Back,
}

/// Which meetings of a ray and a primitive are hits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HitRule {
    /// Primitives are closed sets: touching an edge or a vertex is a hit on every primitive that
    /// shares it. So no ray slips through a seam. A ray that lies in a triangle's plane misses it.
    Touching,
    /// Each crossing of a surface counts once: the ray is taken as moved aside by an infinitesimal
    /// (ε, ε², ε³), so that it meets no edge or vertex (see [`crate::exact`]). A closed mesh is
    /// crossed an even number of times from outside, an odd number from inside.
    Crossing,
}
