//! The surface area heuristic's cost (S10), which nothing else knows the formula of.

/// What the surface area heuristic weighs.
///
/// A random line that meets a box meets a box inside it with a chance of S_child / S, the ratio of
/// their surfaces. So a node with N primitives costs, per line that meets it,
///
/// - as a leaf: `intersection · N`;
/// - cut: `traversal + intersection · (S_L/S · N_L + S_R/S · N_R)`, times `1 − empty_bonus` if one
///   of the children is empty (MacDonald & Booth 1990; the bonus as in Wald & Havran 2006).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CostModel {
    /// The cost of visiting an inner node.
    pub traversal: f64,
    /// The cost of testing a primitive.
    pub intersection: f64,
    /// How much cheaper, from 0 to 1, a split counts that cuts off empty space.
    pub empty_bonus: f64,
    /// When a node is not cut, besides step 2.
    pub termination: Termination,
}

/// When the surface area heuristic makes a leaf of a node that step 2 would still cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Termination {
    /// When no split is cheaper than the leaf.
    #[default]
    Automatic,
    /// When there is no candidate: the cheapest split is taken, whatever it costs, until the leaf
    /// size or the depth limit ends it.
    LimitsOnly,
}

impl Default for CostModel {
    fn default() -> Self {
        Self {
            traversal: 1.0,
            intersection: 1.5,
            empty_bonus: 0.2,
            termination: Termination::Automatic,
        }
    }
}

impl CostModel {
    /// The lecture's `SAH(x) = CostEmpty + SurfaceArea(L)·N(L) + SurfaceArea(R)·N(R)`.
    ///
    /// The formula above is this one over the surface of the node, with CostEmpty / S for the
    /// traversal: a positive factor that all candidates of a node share, and a term that does not
    /// depend on x. So the same x is the least. The lecture compares splits with each other only,
    /// never with a leaf: step 2 alone ends the recursion.
    pub const LECTURE: Self = Self {
        traversal: 1.0,
        intersection: 1.0,
        empty_bonus: 0.0,
        termination: Termination::LimitsOnly,
    };

    /// The cost of a leaf of `count` primitives, for a line that meets it.
    pub fn leaf(&self, count: usize) -> f64 {
        self.intersection * count as f64
    }

    /// The cost of a split, for a line that meets the node: the chances that it meets the lower and
    /// the upper child, and how many primitives they hold.
    #[inline]
    pub fn split(&self, chance: [f64; 2], count: [usize; 2]) -> f64 {
        let tests = chance[0] * count[0] as f64 + chance[1] * count[1] as f64;
        let cost = self.traversal + self.intersection * tests;
        if count[0] == 0 || count[1] == 0 { cost * (1.0 - self.empty_bonus) } else { cost }
    }

    /// Whether a node of `count` primitives is better cut, at `cost`, than left a leaf.
    pub(crate) fn is_worth(&self, cost: f64, count: usize) -> bool {
        self.termination == Termination::LimitsOnly || cost < self.leaf(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_split_costs_what_the_formula_says() {
        let cost = CostModel { empty_bonus: 0.25, ..CostModel::default() };
        assert_eq!(cost.leaf(4), 6.0);
        assert_eq!(cost.split([0.5, 0.75], [2, 4]), 1.0 + 1.5 * (0.5 * 2.0 + 0.75 * 4.0));
        assert_eq!(cost.split([0.5, 0.75], [0, 4]), (1.0 + 1.5 * 3.0) * 0.75);
        assert!(cost.is_worth(5.9, 4) && !cost.is_worth(6.0, 4));
        assert!(CostModel::LECTURE.is_worth(1e9, 1));
    }
}
