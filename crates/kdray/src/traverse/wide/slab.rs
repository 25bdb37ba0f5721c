//! The slab test on eight boxes at once (S4), and the order of those that are met.

use super::aim::Aim;
use super::vector::{Vector, splat};
use crate::layout::{Link, WideNode};
use crate::simd::{Lanes, Lists};
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, mask32x8, u32x8};

/// What the slab test needs of a ray, in all lanes.
#[derive(Clone, Copy)]
pub(super) struct Slabs<S: Lanes> {
    inverse: Vector<S>,
    start: Vector<S>,
    t_near: f32x8<S>,
    t_far: f32x8<S>,
    octant: usize,
}

/// The children of a node whose boxes a ray meets.
pub(super) struct Met<S: Lanes> {
    pub(super) count: usize,
    /// The first that the ray meets; of none, anything.
    pub(super) nearest: Link,
    /// All, the farthest first, with where the ray enters them.
    pub(super) lists: Lists<S>,
}

/// The same, told apart by how many they are.
pub(super) enum Meeting<S: Lanes> {
    None,
    One(Link),
    Several(Met<S>),
}

impl<S: Lanes> Slabs<S> {
    #[inline(always)]
    pub(super) fn new(simd: S, aim: &Aim) -> Self {
        Self {
            inverse: splat(simd, &aim.inverse),
            start: splat(simd, &aim.start),
            t_near: f32x8::splat(simd, aim.t_near),
            t_far: f32x8::splat(simd, aim.t_far),
            octant: aim.octant,
        }
    }

    /// Ends the ray at `t_far`.
    #[inline(always)]
    pub(super) fn end(&mut self, simd: S, t_far: f32) {
        self.t_far = f32x8::splat(simd, t_far);
    }

    /// Where the ray meets the planes on an axis: m and M.
    #[inline(always)]
    fn axis(&self, simd: S, node: &WideNode, axis: usize) -> (f32x8<S>, f32x8<S>) {
        let [low, high] = node.planes(axis);
        let (low, high) = (f32x8::load_array_ref(simd, low), f32x8::load_array_ref(simd, high));
        // t = plane / d − o / d
        let (inverse, start) = (self.inverse[axis], self.start[axis]);
        let (l, h) = (low.mul_sub(inverse, start), high.mul_sub(inverse, start));
        (l.min(h), l.max(h))
    }

    /// The children of a node whose boxes the ray meets.
    #[inline(always)]
    pub(super) fn meet(&self, simd: S, node: &WideNode) -> Met<S> {
        simd.step(
            #[inline(always)]
            || {
                let (t_near, met) = self.test(simd, node);
                self.in_order(simd, node, t_near, met)
            },
        )
    }

    /// The same, sooner where there is none or one: those need no order.
    #[inline(always)]
    pub(super) fn meeting(&self, simd: S, node: &WideNode) -> Meeting<S> {
        simd.step(
            #[inline(always)]
            || {
                let (t_near, met) = self.test(simd, node);
                let places = met.to_bitmask();
                if places == 0 {
                    Meeting::None
                } else if places.is_power_of_two() {
                    Meeting::One(child(node, places.trailing_zeros()))
                } else {
                    Meeting::Several(self.in_order(simd, node, t_near, met))
                }
            },
        )
    }

    /// [`meet`](Self::meet) without the child at a place.
    #[inline(always)]
    pub(super) fn meet_but(&self, simd: S, node: &WideNode, place: u32) -> Met<S> {
        simd.step(
            #[inline(always)]
            || {
                let (t_near, met) = self.test(simd, node);
                let others = mask32x8::from_bitmask(simd, !(1 << place));
                self.in_order(simd, node, t_near, met & others)
            },
        )
    }

    /// Where the ray enters the boxes of a node's children, and which of them it meets.
    #[inline(always)]
    fn test(&self, simd: S, node: &WideNode) -> (f32x8<S>, mask32x8<S>) {
        let (x, y, z) =
            (self.axis(simd, node, 0), self.axis(simd, node, 1), self.axis(simd, node, 2));
        let t_near = x.0.max(y.0).max(z.0.max(self.t_near));
        let t_far = x.1.min(y.1).min(z.1.min(self.t_far));
        (t_near, t_near.simd_le(t_far))
    }

    #[inline(always)]
    fn in_order(&self, simd: S, node: &WideNode, t_near: f32x8<S>, met: mask32x8<S>) -> Met<S> {
        let links = u32x8::load_array_ref(simd, node.links());
        let order = node.order(self.octant);
        let (met, lists) = simd.pack(met, order, Lists { t: t_near, links });
        // The nearest is last. It is looked up in the node: the way by the lists is longer.
        let nearest = child(node, order.rotate_left(met.leading_zeros() * 4 + 4));
        Met { count: met.count_ones() as usize, nearest, lists }
    }
}

/// The child at a place, of which the lowest three bits count.
#[inline(always)]
fn child(node: &WideNode, place: u32) -> Link {
    Link::from_bits(node.links()[(place & 7) as usize])
}
