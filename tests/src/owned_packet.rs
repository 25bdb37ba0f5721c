//! Packets that keep their numbers.

use kdray::geometry::Common;
use kdray::{Interval, Ray, RayPacket};

/// What a [`RayPacket`] borrows.
#[derive(Clone, Debug)]
pub struct OwnedPacket {
    common: Common,
    each: [Vec<f64>; 3],
    intervals: Intervals,
}

#[derive(Clone, Debug)]
enum Intervals {
    Same(Interval),
    Each(Vec<f64>, Vec<f64>),
}

impl OwnedPacket {
    /// Rays that share `common` and differ in `each`, for t from 0 to infinity; to 1 if they go to a
    /// common target.
    pub fn new(common: Common, each: &[[f64; 3]]) -> Self {
        let t_max = if let Common::Target(_) = common { 1.0 } else { f64::INFINITY };
        Self {
            common,
            each: [0, 1, 2].map(|axis| each.iter().map(|it| it[axis]).collect()),
            intervals: Intervals::Same(Interval { t_min: 0.0, t_max }),
        }
    }

    /// The same rays with one interval for all.
    #[must_use]
    pub fn with_interval(&self, interval: Interval) -> Self {
        Self { intervals: Intervals::Same(interval), ..self.clone() }
    }

    /// The same rays, each with its own interval.
    #[must_use]
    pub fn with_intervals(&self, intervals: &[Interval]) -> Self {
        let t_min = intervals.iter().map(|it| it.t_min).collect();
        let t_max = intervals.iter().map(|it| it.t_max).collect();
        Self { intervals: Intervals::Each(t_min, t_max), ..self.clone() }
    }

    /// How many rays there are.
    pub fn len(&self) -> usize {
        self.each[0].len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Only the rays of these numbers.
    #[must_use]
    pub fn only(&self, indices: &[usize]) -> Self {
        let of = |numbers: &Vec<f64>| indices.iter().map(|&index| numbers[index]).collect();
        let intervals = match &self.intervals {
            Intervals::Same(interval) => Intervals::Same(*interval),
            Intervals::Each(t_min, t_max) => Intervals::Each(of(t_min), of(t_max)),
        };
        Self { common: self.common, each: self.each.each_ref().map(of), intervals }
    }

    /// The packet.
    pub fn packet(&self) -> RayPacket<'_> {
        let [x, y, z] = &self.each;
        let packet = RayPacket::new(self.common, [x, y, z]);
        match &self.intervals {
            Intervals::Same(Interval { t_min, t_max }) => packet.with_interval(*t_min, *t_max),
            Intervals::Each(t_min, t_max) => packet.with_intervals(t_min, t_max),
        }
    }

    /// Its rays, each as one that is alone.
    pub fn rays(&self) -> Vec<Ray> {
        let packet = self.packet();
        (0..packet.len()).map(|index| packet.ray(index)).collect()
    }
}
