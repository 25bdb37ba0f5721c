//! A lane of one ray: the interval of each ray, as Wald, Slusallek, Benthin & Wagner (2001) keep it.

use super::super::leaf_walk::inverse;
use super::bound::Bound;
use super::rays::PacketRay;
use super::signs::Signs;
use crate::geometry::{Interval, Ray, t_above, t_below};

/// One ray, with the signs of its packet.
pub(super) struct MaskedRay {
    signs: Signs,
    origin: [f64; 3],
    /// 1 / |d|; see [`inverse`].
    inverse: [f64; 3],
}

impl Bound for MaskedRay {
    type Shared = Signs;
    const HAS_MAILBOX: bool = false;

    fn lane_size(_size: usize) -> usize {
        1
    }

    fn shared(rays: &[PacketRay]) -> Option<Signs> {
        rays.first().map(|ray| Signs::of(ray.ray()))
    }

    fn fits(signs: &Signs, ray: &PacketRay) -> bool {
        Signs::of(ray.ray()) == *signs
    }

    fn around(signs: &Signs, rays: &[PacketRay]) -> Self {
        let Ray { origin, direction, .. } = *rays[0].ray();
        Self { signs: *signs, origin, inverse: direction.map(|d| inverse(d.abs())) }
    }

    fn inside_root(&self, rays: &[PacketRay]) -> Interval {
        rays[0].inside
    }

    fn reach(&self, ray: &Ray<3>) -> f64 {
        ray.interval.t_max
    }

    fn lower_is_near(&self, axis: usize, _split: f64) -> bool {
        self.signs.is_forward(axis)
    }

    /// The three cases of the single traversal, by the same numbers.
    fn children(&self, axis: usize, split: f64, inside: Interval) -> [Interval; 2] {
        let Interval { t_min: t_near, t_max: t_far } = inside;
        let t_split = self.signs.ahead(axis, split - self.origin[axis]) * self.inverse[axis];
        if t_split > t_far {
            [inside, Interval::EMPTY]
        } else if t_split < t_near {
            [Interval::EMPTY, inside]
        } else {
            let near = Interval { t_min: t_near, t_max: t_above(t_split).min(t_far) };
            [near, Interval { t_min: t_below(t_split).max(t_near), t_max: t_far }]
        }
    }
}
