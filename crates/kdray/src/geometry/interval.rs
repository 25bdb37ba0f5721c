//! A closed interval of the ray parameter t.

/// The closed interval `[t_min, t_max]` of a ray's parameter, in units of the direction's length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Where the interval begins; it belongs to the interval.
    pub t_min: f64,
    /// Where the interval ends; it belongs to the interval.
    pub t_max: f64,
}

impl Interval {
    /// From the ray's origin forward without end: `[0, +inf]`.
    pub const FORWARD: Self = Self { t_min: 0.0, t_max: f64::INFINITY };

    /// The whole line, before and behind the origin.
    pub const LINE: Self = Self { t_min: f64::NEG_INFINITY, t_max: f64::INFINITY };

    /// The interval that holds nothing, from which [`union`](Self::union) grows.
    pub const EMPTY: Self = Self { t_min: f64::INFINITY, t_max: f64::NEG_INFINITY };

    /// Whether `t` lies in the interval. Never true for NaN.
    pub fn contains(self, t: f64) -> bool {
        self.t_min <= t && t <= self.t_max
    }

    /// Whether no t lies in the interval, which is also the case when a bound is NaN.
    pub fn is_empty(self) -> bool {
        !matches!(
            self.t_min.partial_cmp(&self.t_max),
            Some(std::cmp::Ordering::Less | std::cmp::Ordering::Equal)
        )
    }

    /// The smallest interval that holds both, neither of which is turned around.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self { t_min: self.t_min.min(other.t_min), t_max: self.t_max.max(other.t_max) }
    }

    /// The part that lies in both intervals; empty if there is none.
    pub fn intersection(self, other: Self) -> Self {
        Self { t_min: self.t_min.max(other.t_min), t_max: self.t_max.min(other.t_max) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_belong_to_the_interval() {
        let interval = Interval { t_min: 1.0, t_max: 2.0 };
        assert!(interval.contains(1.0) && interval.contains(2.0));
        assert!(!interval.contains(f64::NAN) && !interval.contains(2.5));
    }

    #[test]
    fn disjoint_intervals_meet_in_an_empty_one() {
        let before = Interval { t_min: 0.0, t_max: 1.0 };
        let behind = Interval { t_min: 2.0, t_max: 3.0 };
        assert!(before.intersection(behind).is_empty());
        assert!(Interval { t_min: f64::NAN, t_max: 1.0 }.is_empty());
    }

    #[test]
    fn a_union_holds_what_is_between_too() {
        let (first, last) =
            (Interval { t_min: 0.0, t_max: 1.0 }, Interval { t_min: 2.0, t_max: 3.0 });
        assert_eq!(first.union(last), Interval { t_min: 0.0, t_max: 3.0 });
        assert_eq!(Interval::EMPTY.union(last), last);
        assert!(Interval::EMPTY.is_empty());
    }
}
