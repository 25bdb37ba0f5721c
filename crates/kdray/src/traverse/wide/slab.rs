//! The slab test on eight boxes at once (S4), and the order of those that are met.

use super::aim::Aim;
use super::lanes::RayLanes;
use super::stack::Stack;
use crate::layout::{Link, PlaneRows, WideNode};
use crate::simd::{Lanes, Lists};
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, u32x8};

/// The nearest of the children whose boxes the ray meets; puts the others onto the stack, the
/// farthest first.
#[inline(always)]
pub(super) fn nearest_child<S: Lanes>(
    simd: S,
    node: &WideNode,
    aim: &Aim,
    ray: &RayLanes<S>,
    stack: &mut Stack,
) -> Option<Link> {
    // t = plane / d − o / d
    let t = |row: usize, axis: usize| {
        let planes = f32x8::load_array_ref(simd, node.planes(row));
        planes.mul_sub(ray.inverse[axis], ray.start[axis])
    };
    let PlaneRows { near, far } = PlaneRows::of_octant(aim.octant);
    let t_near = t(near[0], 0).max(t(near[1], 1)).max(t(near[2], 2).max(ray.t_near));
    let t_far = t(far[0], 0).min(t(far[1], 1)).min(t(far[2], 2).min(ray.t_far));
    let met = t_near.simd_le(t_far);
    let links = u32x8::load_array_ref(simd, node.links());
    let order = node.order(aim.octant);
    let (met, lists) = simd.pack(met, order, Lists { t: t_near, links });
    // The nearest is last. It is looked up in the node, because the way by the stack takes longer.
    let last = met.checked_ilog2()?;
    stack.push(met.count_ones() as usize - 1, &lists);
    let place = order >> (4 * last) & 7;
    Some(Link::from_bits(node.links()[place as usize]))
}
