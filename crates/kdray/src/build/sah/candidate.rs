//! Planes and what they cost.

use crate::build::CostModel;
use crate::build::plane::{PlanarSide, SplitPlane};
use crate::geometry::Aabb;
use std::cmp::Ordering;

/// A plane and its cost.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub(super) cost: f64,
    pub(super) plane: SplitPlane,
}

impl Candidate {
    /// Whether this one is to be taken rather than `other`: by cost, axis, position, planar side.
    pub(super) fn beats(&self, other: &Self) -> bool {
        let (a, b) = (&self.plane, &other.plane);
        let order = self.cost.total_cmp(&other.cost).then(a.axis.cmp(&b.axis));
        let order = order.then(a.position.total_cmp(&b.position)).then(a.planar.cmp(&b.planar));
        order == Ordering::Less
    }
}

/// The better one.
pub(super) fn better(a: Option<Candidate>, b: Option<Candidate>) -> Option<Candidate> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b.beats(&a) { b } else { a }),
        (a, b) => a.or(b),
    }
}

/// How many primitives lie on which side of a candidate. Those that straddle it count on both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct SideCounts {
    pub(super) below: usize,
    /// In the plane as a whole.
    pub(super) planar: usize,
    pub(super) above: usize,
}

/// A node's cell as the candidates on one axis see it.
///
/// A box's surface is linear in its extent on an axis: `face + rim · extent`, where `face` is the
/// area of the sides perpendicular to the axis, and `rim` half the length around them.
pub(super) struct AxisView {
    axis: usize,
    min: f32,
    max: f32,
    face: f64,
    rim: f64,
    per_surface: f64,
}

impl AxisView {
    /// `None` if the cell has no surface: lines miss it.
    pub(super) fn new<const K: usize>(cell: &Aabb<K>, axis: usize) -> Option<Self> {
        let (extent, surface) = (cell.extent(), cell.half_surface());
        let others = || (0..K).filter(|&other| other != axis);
        let face = others().map(|other| extent[other]).product();
        let rim = others().map(|skip| {
            others().filter(|&other| other != skip).map(|other| extent[other]).product::<f64>()
        });
        let (min, max) = (cell.min[axis], cell.max[axis]);
        let view = Self { axis, min, max, face, rim: rim.sum(), per_surface: 1.0 / surface };
        (surface > 0.0).then_some(view)
    }

    /// Whether a plane at `position` cuts the cell.
    #[inline]
    pub(super) fn is_inside(&self, position: f32) -> bool {
        self.min < position && position < self.max
    }

    /// Whether a position, or one above it, may cut the cell.
    #[inline]
    pub(super) fn is_below_max(&self, position: f32) -> bool {
        position < self.max
    }

    /// The cost of a plane at `position` with so many primitives below and above.
    #[inline]
    pub(super) fn cost(&self, cost: &CostModel, position: f32, counts: [usize; 2]) -> f64 {
        let chance = |min: f32, max: f32| {
            (self.face + self.rim * (f64::from(max) - f64::from(min))) * self.per_surface
        };
        cost.split([chance(self.min, position), chance(position, self.max)], counts)
    }

    /// The plane at `position`, with the planar primitives on the side where they cost less: below
    /// if that makes no difference.
    #[inline]
    pub(super) fn candidate(
        &self,
        cost: &CostModel,
        position: f32,
        counts: SideCounts,
    ) -> Candidate {
        let SideCounts { below, planar, above } = counts;
        let cost_below = self.cost(cost, position, [below + planar, above]);
        let first = self.at(position, PlanarSide::Below, cost_below);
        if planar == 0 {
            return first;
        }
        let cost_above = self.cost(cost, position, [below, above + planar]);
        let second = self.at(position, PlanarSide::Above, cost_above);
        if second.beats(&first) { second } else { first }
    }

    /// The plane at `position`, of known cost.
    #[inline]
    pub(super) fn at(&self, position: f32, planar: PlanarSide, cost: f64) -> Candidate {
        Candidate { cost, plane: SplitPlane { axis: self.axis, position, planar } }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chances_are_ratios_of_surfaces() {
        let cell = Aabb { min: [0.0, 0.0, 0.0], max: [1.0, 2.0, 3.0] };
        let cost = CostModel { traversal: 0.0, intersection: 1.0, ..CostModel::LECTURE };
        for (axis, position) in [(0, 0.25), (1, 1.5), (2, 1.0)] {
            let counts = SideCounts { below: 3, planar: 0, above: 5 };
            let found = AxisView::new(&cell, axis).unwrap().candidate(&cost, position, counts);
            let (below, above) = cell.split(axis, position);
            let expected = (3.0 * below.half_surface() + 5.0 * above.half_surface()) / 11.0;
            assert!((found.cost - expected).abs() < 1e-14, "axis {axis}");
        }
    }

    #[test]
    fn planar_primitives_go_where_they_cost_less() {
        let cell = Aabb { min: [0.0, 0.0], max: [4.0, 1.0] };
        let view = AxisView::new(&cell, 0).unwrap();
        let side = |position, below, above| {
            let counts = SideCounts { below, planar: 2, above };
            view.candidate(&CostModel::default(), position, counts).plane.planar
        };
        assert_eq!(side(1.0, 1, 1), PlanarSide::Below, "the smaller box");
        assert_eq!(side(3.0, 1, 1), PlanarSide::Above, "the smaller box");
        assert_eq!(side(2.0, 1, 1), PlanarSide::Below, "no difference");
        assert_eq!(side(1.9, 0, 3), PlanarSide::Above, "the lower box stays empty");
    }

    #[test]
    fn a_cell_without_surface_has_no_candidates() {
        let line = Aabb { min: [0.0; 3], max: [1.0, 0.0, 0.0] };
        assert!(AxisView::new(&line, 0).is_none());
    }
}
