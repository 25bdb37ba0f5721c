//! What the rays of a frustum share: a point that they come from or go to, or a direction.

use super::rays::PacketRay;
use crate::geometry::{Common, Interval, Ray, t_above, t_below};

/// The steepest ray of a frustum, by the slope against its dominant axis. A wider frustum bounds
/// hardly anything.
const MAX_SLOPE: f64 = 64.0;

/// How far a ray may pass the common target, in parts of its direction: what the rounding of a
/// direction `target − origin` may do, with much to spare.
const TARGET_TOLERANCE: f64 = 1.0 / (1u64 << 32) as f64;

/// The three things that other rays may share with `ray`.
fn all(ray: &Ray<3>) -> [Common; 3] {
    [Common::Origin(ray.origin), Common::Direction(ray.direction), Common::Target(ray.at(1.0))]
}

/// Whether `ray` shares it, and has no part behind it.
fn shares(common: &Common, ray: &Ray<3>) -> bool {
    match common {
        Common::Origin(origin) => ray.origin == *origin && ray.interval.t_min >= 0.0,
        Common::Direction(direction) => ray.direction == *direction && ray.interval.t_min >= 0.0,
        Common::Target(target) => {
            let longest = ray.direction.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
            let missed = (0..3).map(|k| (ray.at(1.0)[k] - target[k]).abs());
            missed.fold(0.0, f64::max) <= TARGET_TOLERANCE * longest && ray.interval.t_max <= 1.0
        }
    }
}

/// Rays that meet, along a dominant axis: a point of a ray lies at a depth z ≥ 0 on that axis from
/// the base, and there at offset + slope · z on the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bundle {
    pub(super) common: Common,
    /// The dominant axis.
    pub(super) axis: usize,
    /// 1 if z grows with the coordinate on the axis, or −1.
    pub(super) sign: f64,
    /// Where z is zero: the apex, or for parallel rays the hindmost origin.
    pub(super) base: [f64; 3],
}

impl Bundle {
    /// The way in which most rays meet the first one.
    pub(super) fn of(rays: &[PacketRay]) -> Option<Self> {
        let ways = all(rays.first()?.ray());
        let count = |way: &Common| rays.iter().filter(|ray| shares(way, ray.ray())).count();
        // Of equal ways the first: `max_by_key` takes the last.
        let common = ways.into_iter().rev().max_by_key(count)?;
        let met: Vec<&Ray<3>> =
            rays.iter().map(PacketRay::ray).filter(|ray| shares(&common, ray)).collect();
        let (axis, forward) = dominant_axis(&met);
        let sign = if forward == matches!(common, Common::Target(_)) { -1.0 } else { 1.0 };
        Some(Self { common, axis, sign, base: base(&common, axis, sign, &met) })
    }

    /// Whether a ray meets the others, not too steeply, and with numbers that can be told.
    pub(super) fn holds(&self, it: &PacketRay) -> bool {
        let ray = it.ray();
        let forward = self.sign * ray.direction[self.axis];
        let runs =
            if matches!(self.common, Common::Target(_)) { forward < 0.0 } else { forward > 0.0 };
        let sides = self.sides();
        runs && shares(&self.common, ray)
            && sides.iter().all(|&side| self.slope(ray, side).abs() <= MAX_SLOPE)
            && sides.iter().all(|&side| self.offset(ray, side)[1].is_finite())
            && self.depths(ray, it.inside).t_max.is_finite()
    }

    /// The two other axes.
    pub(super) fn sides(&self) -> [usize; 2] {
        [(self.axis + 1) % 3, (self.axis + 2) % 3]
    }

    /// How far a ray moves on an axis while z grows by one: right to half a unit in the last place.
    pub(super) fn slope(&self, ray: &Ray<3>, axis: usize) -> f64 {
        ray.direction[axis] / (self.sign * ray.direction[self.axis])
    }

    /// Where a ray is on an axis, from the base, at z = 0: bounds of it.
    pub(super) fn offset(&self, ray: &Ray<3>, axis: usize) -> [f64; 2] {
        let from_base = ray.origin[axis] - self.base[axis];
        let way = self.slope(ray, axis) * self.depth_of_origin(ray);
        let error = rounding(from_base, way);
        [from_base - way - error, from_base - way + error]
    }

    /// The depths between two t of a ray, with slack for the t of hits.
    pub(super) fn depths(&self, ray: &Ray<3>, t: Interval) -> Interval {
        let start = self.depth_of_origin(ray);
        let depth = |t: f64| {
            let way = self.sign * ray.direction[self.axis] * t;
            let error = rounding(start, way);
            Interval { t_min: start + t_below(way) - error, t_max: start + t_above(way) + error }
        };
        let depths = depth(t.t_min).union(depth(t.t_max));
        // The base lies behind all that counts of a ray.
        Interval { t_min: depths.t_min.max(0.0), ..depths }
    }

    fn depth_of_origin(&self, ray: &Ray<3>) -> f64 {
        self.sign * (ray.origin[self.axis] - self.base[self.axis])
    }
}

/// A bound for the error of a sum of two numbers that themselves were rounded a few times.
pub(super) fn rounding(a: f64, b: f64) -> f64 {
    (a.abs() + b.abs()) * (8.0 * f64::EPSILON) + f64::MIN_POSITIVE
}

/// The axis on which the rays go farthest in the mean of their directions, and whether forward.
fn dominant_axis(rays: &[&Ray<3>]) -> (usize, bool) {
    let mut mean = [0.0; 3];
    for ray in rays {
        let longest = ray.direction.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
        for (sum, d) in mean.iter_mut().zip(ray.direction) {
            *sum += d / longest;
        }
    }
    let longer = |a: &usize, b: &usize| mean[*a].abs().total_cmp(&mean[*b].abs());
    let axis = (0..3).max_by(longer).unwrap_or(0);
    (axis, mean[axis] >= 0.0)
}

/// A point from which all rays that meet go towards greater z.
fn base(common: &Common, axis: usize, sign: f64, rays: &[&Ray<3>]) -> [f64; 3] {
    match *common {
        Common::Origin(origin) => origin,
        Common::Direction(_) => {
            let depth = |ray: &&&Ray<3>| sign * ray.origin[axis];
            let hindmost = rays.iter().min_by(|a, b| depth(a).total_cmp(&depth(b)));
            hindmost.map_or([0.0; 3], |ray| ray.origin)
        }
        Common::Target(mut target) => {
            // Rays end near the target only, and hits at their end are right to 2^-39 of t.
            let longest = rays.iter().flat_map(|ray| ray.direction);
            let longest = longest.fold(0.0_f64, |m, d| m.max(d.abs()));
            target[axis] -= sign * 2.0 * TARGET_TOLERANCE * longest;
            target
        }
    }
}
