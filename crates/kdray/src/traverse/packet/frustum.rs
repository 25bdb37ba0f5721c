//! A lane of rays in a bounding frustum: a rectangle of slopes on the dominant axis.
//!
//! Four planes through the apex and the edges of the rectangle bound the rays, and four *corner
//! rays* run where these meet (Reshetov, Soupikov & Hurley 2005; Wald, Boulos & Shirley 2007). For
//! parallel rays the rectangle is one of offsets, and the frustum a prism.

use super::bound::Bound;
use super::bundle::{Bundle, rounding};
use super::cull::Cull;
use super::rays::PacketRay;
use crate::geometry::{Common, Interval, Ray, t_above, t_below};

/// A frustum around rays that come from one point, go to one point, or are parallel.
///
/// Its t is the depth on the dominant axis: every ray counts as if that component of its direction
/// were one. So one plane has one t_split for all rays of a frustum, if it is perpendicular to the
/// dominant axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frustum {
    pub(super) bundle: Bundle,
    /// On each axis what no ray is below, counted from the base.
    pub(super) low: [Line; 3],
    /// On each axis what no ray is above.
    pub(super) high: [Line; 3],
    /// Where the rays are in the tree's box.
    inside: Interval,
}

/// A coordinate that changes with depth: offset + slope · z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Line {
    pub(super) offset: f64,
    pub(super) slope: f64,
}

impl Line {
    fn mirrored(self) -> Self {
        Self { offset: -self.offset, slope: -self.slope }
    }

    /// The part of `inside` in which the line is not above `limit`.
    fn part_below(self, limit: f64, inside: Interval) -> Interval {
        let gap = limit - self.offset + rounding(limit, self.offset);
        let part = if self.slope > 0.0 {
            Interval { t_max: inside.t_max.min(t_above(gap / self.slope)), ..inside }
        } else if self.slope < 0.0 {
            Interval { t_min: inside.t_min.max(t_below(gap / self.slope)), ..inside }
        } else if gap < 0.0 {
            Interval::EMPTY
        } else {
            inside
        };
        if part.is_empty() { Interval::EMPTY } else { part }
    }
}

impl Frustum {
    /// The dominant axis.
    pub fn axis(&self) -> usize {
        self.bundle.axis
    }

    /// The depths on the dominant axis between which the rays are in the tree's box.
    pub fn depths(&self) -> Interval {
        self.inside
    }

    /// The corner rays: t is the depth on the dominant axis. Neighbours share a side.
    pub fn corner_rays(&self) -> [Ray<3>; 4] {
        let [i, j] = self.bundle.sides();
        let corner = |first: Line, second: Line| {
            let (mut origin, mut direction) = (self.bundle.base, [0.0; 3]);
            for (axis, line) in [(i, first), (j, second)] {
                origin[axis] += line.offset;
                direction[axis] = line.slope;
            }
            direction[self.bundle.axis] = self.bundle.sign;
            Ray::new(origin, direction)
        };
        let (low, high) = (self.low, self.high);
        [
            corner(low[i], low[j]),
            corner(high[i], low[j]),
            corner(high[i], high[j]),
            corner(low[i], high[j]),
        ]
    }
}

impl Bound for Frustum {
    type Shared = Bundle;
    const HAS_MAILBOX: bool = true;

    fn lane_size(size: usize) -> usize {
        size.div_ceil(super::LANES)
    }

    fn shared(rays: &[PacketRay]) -> Option<Bundle> {
        Bundle::of(rays)
    }

    fn fits(bundle: &Bundle, ray: &PacketRay) -> bool {
        bundle.holds(ray)
    }

    fn around(bundle: &Bundle, rays: &[PacketRay]) -> Self {
        let middle = Line { offset: 0.0, slope: bundle.sign };
        let mut frustum =
            Self { bundle: *bundle, low: [middle; 3], high: [middle; 3], inside: Interval::EMPTY };
        for axis in bundle.sides() {
            let least = |values: &dyn Fn(&Ray<3>) -> f64| {
                rays.iter().map(|ray| values(ray.ray())).fold(f64::INFINITY, f64::min)
            };
            frustum.low[axis] = Line {
                offset: least(&|ray| bundle.offset(ray, axis)[0]),
                slope: least(&|ray| bundle.slope(ray, axis)).next_down(),
            };
            frustum.high[axis] = Line {
                offset: -least(&|ray| -bundle.offset(ray, axis)[1]),
                slope: (-least(&|ray| -bundle.slope(ray, axis))).next_up(),
            };
        }
        frustum.inside = frustum.inside_root(rays);
        frustum
    }

    fn inside_root(&self, rays: &[PacketRay]) -> Interval {
        let depths = rays.iter().map(|ray| self.bundle.depths(ray.ray(), ray.inside));
        depths.fold(Interval::EMPTY, Interval::union)
    }

    fn reach(&self, ray: &Ray<3>) -> f64 {
        self.bundle.depths(ray, ray.interval).t_max
    }

    fn lower_is_near(&self, axis: usize, split: f64) -> bool {
        match self.bundle.common {
            Common::Direction(_) => self.low[axis].slope > 0.0,
            // The near child is the side that holds the apex.
            Common::Origin(_) | Common::Target(_) => split > self.bundle.base[axis],
        }
    }

    fn children(&self, axis: usize, split: f64, inside: Interval) -> [Interval; 2] {
        let distance = split - self.bundle.base[axis];
        let lower = self.low[axis].part_below(distance, inside);
        let upper = self.high[axis].mirrored().part_below(-distance, inside);
        if self.lower_is_near(axis, split) { [lower, upper] } else { [upper, lower] }
    }

    fn misses(&self, primitives: &impl Cull, id: u32) -> bool {
        primitives.misses(id, self)
    }

    fn as_frustum(&self) -> Option<&Frustum> {
        Some(self)
    }
}
