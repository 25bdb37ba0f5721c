//! A lane of all rays: one interval for the packet, by interval arithmetic.
//!
//! The t_split of all rays lies between bounds that come from the range of their origins and that of
//! their inverse directions (Reshetov, Soupikov & Hurley 2005; Boulos, Wald & Shirley 2006). A child
//! is left out if the bounds alone say that no ray can be in it.

use super::bound::Bound;
use super::rays::PacketRay;
use super::signs::Signs;
use crate::geometry::{Interval, Ray, t_above, t_below};

/// Rays of common direction signs.
pub(super) struct RayInterval {
    signs: Signs,
    /// The least and the greatest coordinate of the origins.
    origins: [[f64; 2]; 3],
    /// The least and the greatest 1 / |d|. The least is finite, also for a d of zero.
    inverses: [[f64; 2]; 3],
}

impl Bound for RayInterval {
    type Shared = Signs;
    const HAS_MAILBOX: bool = false;

    fn lane_size(size: usize) -> usize {
        size
    }

    fn shared(rays: &[PacketRay]) -> Option<Signs> {
        rays.first().map(|ray| Signs::of(ray.ray()))
    }

    fn fits(signs: &Signs, ray: &PacketRay) -> bool {
        Signs::of(ray.ray()) == *signs
    }

    fn around(signs: &Signs, rays: &[PacketRay]) -> Self {
        let origins = |axis: usize| range(rays.iter().map(|ray| ray.ray().origin[axis]));
        let inverses = |axis: usize| {
            let [least, greatest] =
                range(rays.iter().map(|ray| 1.0 / ray.ray().direction[axis].abs()));
            [least.min(f64::MAX), greatest]
        };
        Self { signs: *signs, origins: [0, 1, 2].map(origins), inverses: [0, 1, 2].map(inverses) }
    }

    fn inside_root(&self, rays: &[PacketRay]) -> Interval {
        rays.iter().map(|ray| ray.inside).fold(Interval::EMPTY, Interval::union)
    }

    fn reach(&self, ray: &Ray<3>) -> f64 {
        ray.interval.t_max
    }

    fn lower_is_near(&self, axis: usize, _split: f64) -> bool {
        self.signs.is_forward(axis)
    }

    fn children(&self, axis: usize, split: f64, inside: Interval) -> [Interval; 2] {
        let [first, last] = self.t_split(axis, split);
        let near = Interval { t_max: inside.t_max.min(last), ..inside };
        let far = Interval { t_min: inside.t_min.max(first), ..inside };
        [near, far].map(|part| if part.is_empty() { Interval::EMPTY } else { part })
    }
}

impl RayInterval {
    /// Bounds of the t_split of all rays.
    fn t_split(&self, axis: usize, split: f64) -> [f64; 2] {
        let [low, high] = self.origins[axis].map(|origin| split - origin);
        let (low, high) = (self.signs.ahead(axis, low), self.signs.ahead(axis, high));
        let (low, high) = (low.min(high), low.max(high));
        let [least, greatest] = self.inverses[axis];
        let first = low * if low < 0.0 { greatest } else { least };
        // In the plane of a ray that is parallel to it, 0 · inf = NaN: it is there for all t.
        let last = high * if high < 0.0 { least } else { greatest };
        let first = if low <= 0.0 && high >= 0.0 && greatest.is_infinite() {
            f64::NEG_INFINITY
        } else {
            t_below(first)
        };
        [first, if last.is_nan() { f64::INFINITY } else { t_above(last) }]
    }
}

/// The least and the greatest value.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, greatest], value| {
        [least.min(value), greatest.max(value)]
    })
}
