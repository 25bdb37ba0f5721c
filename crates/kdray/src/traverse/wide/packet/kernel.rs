//! A packet through the wide tree.

use super::finish::{Seen, finish};
use super::forms::Table;
use super::frustum::Frustum;
use super::pace::{Pace, PacketWork, Plan};
use super::parallel::Parallel;
use super::perspective::Perspective;
use super::prepare::{locals, place};
use super::projection::{Frame, Projection};
use super::rays::NONE;
use super::scratch::Scratch;
use super::search::Search;
use crate::geometry::{Common, RayPacket};
use crate::layout::{Link, WideTree};
use crate::primitives::HitArrays;
use crate::simd::{Kernel, Lanes, Lists};
use crate::traverse::wide::line::FARTHEST;
use fearless_simd::prelude::*;
use fearless_simd::u32x8;

/// Answers to the rays of a packet.
pub(crate) enum Answers<'a> {
    Closest(&'a mut HitArrays),
    Any(&'a mut [bool]),
}

/// All packets of a query.
pub(crate) struct Packets<'a, const ANY: bool> {
    pub(crate) tree: &'a WideTree,
    pub(crate) packet: &'a RayPacket<'a>,
    pub(crate) answers: Answers<'a>,
    /// Rays that are to be answered one by one.
    pub(crate) left: &'a mut Vec<u32>,
    pub(crate) scratch: &'a mut Scratch,
}

impl<const ANY: bool> Kernel for Packets<'_, ANY> {
    type Output = PacketWork;

    #[inline(always)]
    fn run<S: Lanes>(mut self, simd: S) -> PacketWork {
        // Seen from the target, the closest hit is the last. Plain Rust has no packets (0012).
        let is_last = !ANY && matches!(self.packet.common(), Common::Target(_));
        if !S::HAS_VECTORS || is_last {
            self.left.extend(0..self.packet.len() as u32);
            return PacketWork { left: self.left.len(), ..PacketWork::default() };
        }
        let mut total = PacketWork::default();
        let mut pace = Pace::new(ANY);
        let mut first = 0;
        while first < self.packet.len() {
            let plan = pace.plan();
            let count = plan.size().min(self.packet.len() - first);
            let mut cost = 0;
            if plan == Plan::Alone {
                self.left.extend(first as u32..(first + count) as u32);
            } else {
                let work = self.one(simd, (first, count), pace.budget(count));
                cost = work.cost();
                total += work;
            }
            pace.learn(plan, cost, count);
            first += count;
        }
        total.left = self.left.len();
        total
    }
}

impl<const ANY: bool> Packets<'_, ANY> {
    #[inline(always)]
    fn one<S: Lanes>(&mut self, simd: S, range: (usize, usize), budget: usize) -> PacketWork {
        let local = &mut self.scratch.local;
        match self.packet.common() {
            Common::Origin(center) => {
                let (toward, _) = locals(simd, self.packet, range, center, local);
                let frame = Frame::new(center, toward);
                self.search(simd, (range, budget), Perspective::of_origin(frame), &frame)
            }
            Common::Target(center) => {
                let (toward, farthest) = locals(simd, self.packet, range, center, local);
                let frame = Frame::new(center, toward);
                let projection = Perspective::of_target(frame, farthest);
                self.search(simd, (range, budget), projection, &frame)
            }
            Common::Direction(direction) => {
                let [x, y, z] = self.packet.each();
                let middle = range.0 + range.1 / 2;
                let center = [x[middle], y[middle], z[middle]];
                let (_, farthest) = locals(simd, self.packet, range, center, local);
                let projection = Parallel::new(center, direction, farthest);
                self.search(simd, (range, budget), projection, &projection.frame)
            }
        }
    }

    #[inline(always)]
    fn search<S: Lanes, P: Projection>(
        &mut self,
        simd: S,
        (range, budget): ((usize, usize), usize),
        projection: P,
        frame: &Frame,
    ) -> PacketWork {
        let reach = self.tree.reach();
        if !projection.is_within(reach * FARTHEST as f32) {
            self.left.extend(range.0 as u32..(range.0 + range.1) as u32);
            return PacketWork::default();
        }
        let left_before = self.left.len();
        let Scratch { local, rays, stack, found, .. } = &mut *self.scratch;
        found.clear();
        let bounds = place(simd, self.packet, range, (&projection, frame), local, rays, self.left);
        let frustum: Frustum<S> = projection.frustum(simd, reach, &bounds);
        let octant = projection.octant(&bounds);
        let mut search = Search::<P, ANY> {
            packet: self.packet,
            first: range.0,
            projection,
            rays,
            bounds,
            mailbox: Search::<P, ANY>::EMPTY_MAILBOX,
            table: Table::EMPTY,
            found,
            work: PacketWork::default(),
        };
        stack.clear();
        let mut next = Link::ROOT;
        let mut z_far = projection.z_above(search.bounds.low);
        let mut is_given_up = false;
        while next != Link::END {
            if next.is_leaf() {
                for index in 0..next.block_count() {
                    search.visit(simd, self.tree.block(next, index));
                }
                if search.bounds.low == f32::INFINITY {
                    break;
                }
                z_far = projection.z_above(search.bounds.low);
                if search.work.cost() > budget {
                    is_given_up = true;
                    break;
                }
            } else {
                search.work.nodes += 1;
                let node = self.tree.node(next);
                let (z, met) = frustum.test(simd, node, z_far);
                let links = u32x8::load_array_ref(simd, node.links());
                let (met, lists) = simd.pack(met, node.order(octant), Lists { t: z, links });
                let count = met.count_ones() as usize;
                stack.push_lists(&lists, count, true);
            }
            next = stack.pop_up_to(z_far, true);
        }
        let work = PacketWork { packets: 1, ..search.work };
        if is_given_up {
            self.left.truncate(left_before);
            self.leave_open(range);
        }
        let Scratch { rays, found, seen, .. } = &mut *self.scratch;
        match &mut self.answers {
            Answers::Any(is_hit) => {
                let is_hit = is_hit[range.0..range.0 + range.1].iter_mut();
                for (is_hit, &slot) in is_hit.zip(rays.slot.as_flattened()) {
                    *is_hit = slot != NONE;
                }
            }
            Answers::Closest(hits) => {
                if !is_given_up {
                    seen.clear();
                    if let Common::Origin(origin) = self.packet.common() {
                        seen.extend(found.iter().map(|it| Seen::new(origin, &it.corners)));
                    }
                    finish(simd, (found, seen), self.packet, range, rays, hits);
                }
            }
        }
        work
    }

    /// Leaves the rays of a packet that was given up: of any hits those that hit nothing yet.
    #[cold]
    fn leave_open(&mut self, (first, count): (usize, usize)) {
        let rays = &self.scratch.rays;
        for (index, &slot) in rays.slot.as_flattened()[..count].iter().enumerate() {
            if !ANY || slot == NONE {
                self.left.push((first + index) as u32);
            }
        }
    }
}
