//! Blocks of rays that share an origin or a direction: those of cameras and scanners, of parallel light.

use crate::order::Order;
use kdray::geometry::Common;
use kdray::{Interval, Ray, RayPacket};

/// Fewer rays than this are no packet.
const LEAST: usize = 64;

/// Room for what the rays of a block do not share.
#[derive(Debug, Default)]
pub(crate) struct Packet {
    order: Order,
    each: [Vec<f64>; 3],
    t_min: Vec<f64>,
    t_max: Vec<f64>,
}

impl Packet {
    /// The rays as a packet, in another order: the index of each.
    pub(crate) fn of(&mut self, common: Common, rays: &[Ray]) -> (RayPacket<'_>, &[u32]) {
        let order = self.order.of(common, rays);
        let chosen = || order.iter().map(|&index| &rays[index as usize]);
        let [x, y, z] = &mut self.each;
        for numbers in [&mut *x, y, z] {
            numbers.clear();
        }
        for ray in chosen() {
            let own = if let Common::Origin(_) = common { ray.direction } else { ray.origin };
            x.push(own[0]);
            y.push(own[1]);
            z.push(own[2]);
        }
        let packet = RayPacket::new(common, [x, y, z]);
        if let Some(Interval { t_min, t_max }) = same_interval(rays) {
            return (packet.with_interval(t_min, t_max), order);
        }
        replace(&mut self.t_min, chosen().map(|ray| ray.interval.t_min));
        replace(&mut self.t_max, chosen().map(|ray| ray.interval.t_max));
        (packet.with_intervals(&self.t_min, &self.t_max), order)
    }
}

/// What all rays share, if anything. Nothing is equal to a NaN.
pub(crate) fn common(rays: &[Ray]) -> Option<Common> {
    let first = rays.first().filter(|_| rays.len() >= LEAST)?;
    if rays.iter().all(|ray| ray.origin == first.origin) {
        return Some(Common::Origin(first.origin));
    }
    let is_parallel = rays.iter().all(|ray| ray.direction == first.direction);
    is_parallel.then_some(Common::Direction(first.direction))
}

fn same_interval(rays: &[Ray]) -> Option<Interval> {
    let first = rays.first()?.interval;
    rays.iter().all(|ray| ray.interval == first).then_some(first)
}

fn replace(room: &mut Vec<f64>, numbers: impl Iterator<Item = f64>) {
    room.clear();
    room.extend(numbers);
}
