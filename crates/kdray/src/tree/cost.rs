//! The surface area heuristic's cost (S10), which nothing else knows the formula of.

use thiserror::Error;

/// What the surface area heuristic weighs.
///
/// A random line that meets a box meets a box inside it with a chance of S_child / S, the ratio of
/// their surfaces. So a node with N primitives costs, per line that meets it,
///
/// - as a leaf: `leaf + intersection · ⌈N / block⌉`, or nothing if it is empty;
/// - cut: `traversal + intersection · (S_L/S · N_L + S_R/S · N_R)`, times `1 − empty_bonus` if one
///   of the children is empty (MacDonald & Booth 1990; the bonus as in Wald & Havran 2006).
///
/// Here N_L and N_R are the means of the number of primitives and of that number rounded up to
/// whole blocks. A cut is weighed greedily, as if its children were not to be cut again. They will
/// be, and then primitives count one by one; but to fill blocks saves tests and memory. The whole
/// price of a block counts once the leaves are there, by pruning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CostModel {
    /// The cost of visiting an inner node.
    pub traversal: f64,
    /// The cost of testing a primitive, or a block of them at once.
    pub intersection: f64,
    /// The cost of visiting a leaf that is not empty, whatever it lists.
    pub leaf: f64,
    /// How many primitives are tested at once: a power of two.
    pub block: usize,
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

/// Why no tree can be built by a cost model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum CostModelError {
    /// The cost of visiting an inner node is out of range.
    #[error("the cost of a traversal step is negative or not finite; give 0 or more")]
    Traversal,
    /// The cost of testing a primitive is out of range.
    #[error("the cost of an intersection test is negative or not finite; give 0 or more")]
    Intersection,
    /// The cost of visiting a leaf is out of range.
    #[error("the cost of a leaf is negative or not finite; give 0 or more")]
    Leaf,
    /// The size of a block is no power of two.
    #[error("the size of a block is not a power of two; give 1, 2, 4, 8 or so on")]
    Block,
    /// The empty-space bonus is out of range.
    #[error("the bonus for empty space is out of range; give a number from 0 to 1")]
    EmptyBonus,
}

impl Default for CostModel {
    fn default() -> Self {
        Self {
            traversal: 1.0,
            intersection: 1.5,
            leaf: 0.0,
            block: 1,
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
        leaf: 0.0,
        block: 1,
        empty_bonus: 0.0,
        termination: Termination::LimitsOnly,
    };

    /// For leaves whose primitives are tested eight at once: a block costs three steps down the tree,
    /// and a leaf a step besides, as the kernels of the wide tree were measured.
    pub const BLOCKS_OF_8: Self = Self {
        traversal: 1.0,
        intersection: 3.0,
        leaf: 1.0,
        block: 8,
        empty_bonus: 0.8,
        termination: Termination::Automatic,
    };

    /// Says what, if anything, keeps a tree from being built by this: costs that are negative or
    /// not finite, or a bonus that is not from 0 to 1.
    pub fn check(&self) -> Result<(), CostModelError> {
        let is_cost = |x: f64| x.is_finite() && x >= 0.0;
        if !is_cost(self.traversal) {
            return Err(CostModelError::Traversal);
        }
        if !is_cost(self.intersection) {
            return Err(CostModelError::Intersection);
        }
        if !is_cost(self.leaf) {
            return Err(CostModelError::Leaf);
        }
        if !self.block.is_power_of_two() {
            return Err(CostModelError::Block);
        }
        if !(0.0..=1.0).contains(&self.empty_bonus) {
            return Err(CostModelError::EmptyBonus);
        }
        Ok(())
    }

    /// The cost of a leaf of `count` primitives, for a line that meets it. Blocks of nothing count as of one, for
    /// figures may be asked for by a model that no build has [checked](Self::check).
    pub fn leaf(&self, count: usize) -> f64 {
        let visit = if count == 0 { 0.0 } else { self.leaf };
        visit + self.intersection * count.div_ceil(self.block.max(1)) as f64
    }

    /// The cost of a split, for a line that meets the node: the chances that it meets the lower and
    /// the upper child, and how many primitives they hold.
    ///
    /// # Panics
    /// In debug builds, by blocks of nothing, which [`check`](Self::check) refuses.
    #[inline]
    pub fn split(&self, chance: [f64; 2], count: [usize; 2]) -> f64 {
        let tests = chance[0] * self.weight(count[0]) + chance[1] * self.weight(count[1]);
        let cost = self.traversal + self.intersection * tests;
        if count[0] == 0 || count[1] == 0 { cost * (1.0 - self.empty_bonus) } else { cost }
    }

    /// For how many tests so many primitives count while a cut is weighed.
    #[inline]
    fn weight(&self, count: usize) -> f64 {
        let mask = self.block - 1;
        let in_blocks = (count + mask) & !mask;
        // Signed numbers become floats faster.
        0.5 * (count + in_blocks) as i64 as f64
    }

    /// Whether a node of `count` primitives is better cut, at `cost`, than left a leaf.
    pub(crate) fn is_worth(&self, cost: f64, count: usize) -> bool {
        self.termination == Termination::LimitsOnly || cost < self.intersection * self.weight(count)
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

    #[test]
    fn blocks_count_whole_in_leaves_and_by_half_in_splits() {
        let cost = CostModel::BLOCKS_OF_8;
        assert_eq!([0, 1, 8, 9, 16].map(|count| cost.leaf(count)), [0.0, 4.0, 4.0, 7.0, 7.0]);
        let (below, above) = (0.5 * (3 + 8) as f64, 0.5 * (9 + 16) as f64);
        assert_eq!(cost.split([0.5, 0.75], [3, 9]), 1.0 + 3.0 * (0.5 * below + 0.75 * above));
    }

    #[test]
    fn costs_out_of_range_are_named() {
        let good = CostModel::default();
        for bad in [-1.0, f64::NAN, f64::INFINITY] {
            let traversal = CostModel { traversal: bad, ..good };
            assert_eq!(traversal.check(), Err(CostModelError::Traversal));
            let intersection = CostModel { intersection: bad, ..good };
            assert_eq!(intersection.check(), Err(CostModelError::Intersection));
            let leaf = CostModel { leaf: bad, ..good };
            assert_eq!(leaf.check(), Err(CostModelError::Leaf));
            let empty_bonus = CostModel { empty_bonus: bad, ..good };
            assert_eq!(empty_bonus.check(), Err(CostModelError::EmptyBonus));
        }
        for bad in [0, 3, 12] {
            assert_eq!(CostModel { block: bad, ..good }.check(), Err(CostModelError::Block));
        }
        assert_eq!(good.check(), Ok(()));
        assert_eq!(CostModel::LECTURE.check(), Ok(()));
        assert_eq!(CostModel::BLOCKS_OF_8.check(), Ok(()));
    }
}
