//! The numbers of the hits that were found.
//!
//! The same as [`intersect_triangle`] computes, to the last bit, eight rays at a time, triangle by
//! triangle: where all of a hit's numbers are good by its first and fastest tests. Others it computes
//! itself. Its range tests are left out, because packets hold only rays and trees whose numbers pass
//! them.

use super::rays::{MOST_VECTORS, NONE, PacketRays};
use super::search::Found;
use crate::geometry::{Common, RayPacket};
use crate::primitives::triangle::{BARYCENTRIC_ERROR, EDGE_ERROR, RELATIVE_ERROR, TERM_ERROR};
use crate::primitives::{HitArrays, HitRule, intersect_triangle};
use crate::simd::Lanes;
use fearless_simd::prelude::*;
use fearless_simd::{f64x8, mask64x8, u32x8};
use glam::DVec3;

type Vector<S> = [f64x8<S>; 3];

/// den is good, and u and v are, from so much on of D · ē · M, and of D · ē²: what the scalar test asks by
/// its first and fastest bounds.
const LEAST_BY_DISTANCE: f64 = EDGE_ERROR / BARYCENTRIC_ERROR;
const LEAST_BY_EDGE: f64 = 2.0 * TERM_ERROR / RELATIVE_ERROR;

/// T is good from so much on of ē² · M, and far from underflow.
const LEAST_VOLUME: f64 = 6.0 * TERM_ERROR / RELATIVE_ERROR;
const FAR_FROM_UNDERFLOW: f64 = 1e-270;

/// Computes the hits of `count` rays from `first` on, on the triangles that were found; `seen` are those
/// of rays with a common origin, and empty otherwise.
#[inline(never)]
pub(super) fn finish<S: Lanes>(
    simd: S,
    triangles: (&[Found], &[Seen]),
    packet: &RayPacket<'_>,
    range: (usize, usize),
    rays: &PacketRays,
    hits: &mut HitArrays,
) {
    // Once for each instruction set, not in each kernel.
    simd.vectorize(
        #[inline(always)]
        || compute(simd, triangles, packet, range, rays, hits),
    );
}

#[inline(always)]
fn compute<S: Lanes>(
    simd: S,
    (found, seen): (&[Found], &[Seen]),
    packet: &RayPacket<'_>,
    (first, count): (usize, usize),
    rays: &PacketRays,
    hits: &mut HitArrays,
) {
    for vector in 0..count.div_ceil(8) {
        let slots = &rays.slot[vector % MOST_VECTORS];
        let begin = first + 8 * vector;
        let present = (count - 8 * vector).min(8);
        if present < 8 {
            ones(found, packet, begin, &slots[..present], 255, hits);
            continue;
        }
        let wanted = !lanes_of(simd, slots, NONE) & 255;
        let mut numbers = Numbers::none(simd);
        if wanted != 0 {
            let rays = Eight::new(simd, packet, begin);
            let mut left = wanted;
            while left != 0 {
                let slot = slots[left.trailing_zeros() as usize & 7];
                let same = lanes_of(simd, slots, slot);
                let hits = match seen.get(slot as usize) {
                    Some(seen) => rays.hits_of_seen(simd, seen),
                    None => rays.hits(simd, &in_all_lanes(simd, &found[slot as usize])),
                };
                numbers.replace(simd, same, &hits);
                left &= !same;
            }
        }
        let mut ids = [NONE; 8];
        for (id, &slot) in ids.iter_mut().zip(slots) {
            *id = found.get(slot as usize).map_or(NONE, |found| found.id);
        }
        numbers.put(simd, wanted, &ids, begin, hits);
        let bad = wanted & !(numbers.good.to_bitmask() as u32);
        if bad != 0 {
            ones(found, packet, begin, slots, bad, hits);
        }
    }
}

/// The lanes with a slot.
#[inline(always)]
fn lanes_of<S: Lanes>(simd: S, slots: &[u32; 8], slot: u32) -> u32 {
    u32x8::load_array_ref(simd, slots).simd_eq(slot).to_bitmask() as u32
}

/// Computes some of the hits one by one.
#[inline(never)]
fn ones(
    found: &[Found],
    packet: &RayPacket<'_>,
    first: usize,
    slots: &[u32],
    lanes: u32,
    hits: &mut HitArrays,
) {
    for (lane, &slot) in slots.iter().enumerate().filter(|(lane, _)| lanes >> lane & 1 == 1) {
        let index = first + lane;
        let hit = found.get(slot as usize).and_then(|&Found { corners, id }| {
            intersect_triangle(&corners, id, &packet.ray(index), HitRule::Touching)
        });
        hits.set(index, hit);
    }
}

/// The corners of a triangle in all lanes.
#[inline(always)]
fn in_all_lanes<S: Lanes>(simd: S, found: &Found) -> [Vector<S>; 3] {
    let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = found.corners;
    let all = |x: f32| f64x8::splat(simd, f64::from(x));
    [[all(ax), all(ay), all(az)], [all(bx), all(by), all(bz)], [all(cx), all(cy), all(cz)]]
}

/// Origins and directions of eight rays.
struct Eight<S: Lanes> {
    o: Vector<S>,
    d: Vector<S>,
}

/// The numbers of eight hits.
#[derive(Clone, Copy)]
struct Numbers<S: Lanes> {
    t: f64x8<S>,
    u: f64x8<S>,
    v: f64x8<S>,
    den: f64x8<S>,
    good: mask64x8<S>,
}

impl<S: Lanes> Eight<S> {
    #[inline(always)]
    fn new(simd: S, packet: &RayPacket<'_>, first: usize) -> Self {
        let all = |[x, y, z]: [f64; 3]| -> Vector<S> {
            [f64x8::splat(simd, x), f64x8::splat(simd, y), f64x8::splat(simd, z)]
        };
        let [x, y, z] = packet.each();
        let each = |numbers: &[f64]| f64x8::from_slice(simd, &numbers[first..first + 8]);
        let own = [each(x), each(y), each(z)];
        let (o, d) = match packet.common() {
            Common::Origin(origin) => (all(origin), own),
            Common::Direction(direction) => (own, all(direction)),
            Common::Target(target) => (own, difference(all(target), own)),
        };
        Self { o, d }
    }

    /// The hits on a triangle of rays that start at the point it is seen from.
    #[inline(always)]
    fn hits_of_seen(&self, simd: S, seen: &Seen) -> Numbers<S> {
        let all = |[x, y, z]: &[f64; 3]| -> Vector<S> {
            [f64x8::splat(simd, *x), f64x8::splat(simd, *y), f64x8::splat(simd, *z)]
        };
        let d = self.d;
        let p = cross(d, all(&seen.e2));
        let (u, v, den) = (dot(p, all(&seen.s)), dot(all(&seen.q), d), dot(p, all(&seen.e1)));
        let length = d[0].abs() + d[1].abs() + d[2].abs();
        let good = (length * seen.least_den).simd_le(den.abs());
        let good = good & mask64x8::splat(simd, seen.volume != 0.0);
        Numbers::of(simd, [f64x8::splat(simd, seen.volume), u, v, den], good)
    }

    #[inline(always)]
    fn hits(&self, simd: S, &[a, b, c]: &[Vector<S>; 3]) -> Numbers<S> {
        let (o, d) = (self.o, self.d);
        let (e1, e2, s) = (difference(b, a), difference(c, a), difference(o, a));
        let p = cross(d, e2);
        let q = cross(s, e1);
        let (u, v, den) = (dot(p, s), dot(q, d), dot(p, e1));
        let volume = dot(q, e2);

        let edges = largest(e1).max(largest(e2));
        let [dx, dy, dz] = [d[0].abs(), d[1].abs(), d[2].abs()];
        let d_scale = (dx + dy + dz) * edges;
        let s_scale = edges.max(largest(s));
        let least_den = (s_scale * LEAST_BY_DISTANCE).max(edges * LEAST_BY_EDGE) * d_scale;
        let terms = (s_scale * edges) * edges;
        let least_volume = terms * LEAST_VOLUME + FAR_FROM_UNDERFLOW;
        let good = least_den.simd_le(den.abs()) & least_volume.simd_le(volume.abs());
        Numbers::of(simd, [volume, u, v, den], good)
    }
}

/// What all rays from one point share that hit a triangle.
#[derive(Clone, Copy)]
pub(super) struct Seen {
    e1: [f64; 3],
    e2: [f64; 3],
    s: [f64; 3],
    q: [f64; 3],
    /// T; zero where it is not good.
    volume: f64,
    /// den is good if it is not smaller than this times |d|₁.
    least_den: f64,
}

impl Seen {
    pub(super) fn new(origin: [f64; 3], corners: &[[f32; 3]; 3]) -> Self {
        let [a, b, c] = corners.map(|p| DVec3::from(p.map(f64::from)));
        let (e1, e2, s) = (b - a, c - a, DVec3::from(origin) - a);
        let q = s.cross(e1);
        let volume = q.dot(e2);
        let edges = e1.abs().max(e2.abs()).max_element();
        let s_scale = edges.max(s.abs().max_element());
        let least_den = (s_scale * LEAST_BY_DISTANCE).max(edges * LEAST_BY_EDGE) * edges;
        // The scalar test multiplies in another order, and rounds otherwise.
        let least_den = least_den * (1.0 + 4.0 * f64::EPSILON);
        let terms = s_scale * edges * edges;
        let is_good = terms * LEAST_VOLUME + FAR_FROM_UNDERFLOW <= volume.abs();
        let volume = if is_good { volume } else { 0.0 };
        let [e1, e2, s, q] = [e1, e2, s, q].map(Into::into);
        Self { e1, e2, s, q, volume, least_den }
    }
}

impl<S: Lanes> Numbers<S> {
    /// From T, U, V and den.
    #[inline(always)]
    fn of(simd: S, [volume, u, v, den]: [f64x8<S>; 4], good: mask64x8<S>) -> Self {
        let inverse = f64x8::splat(simd, 1.0) / den;
        let (zero, one) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, 1.0));
        let u = (u * inverse).max(zero).min(one);
        let v = (v * inverse).max(zero).min(one).min(one - u);
        Self { t: volume / den, u, v, den, good }
    }

    #[inline(always)]
    fn none(simd: S) -> Self {
        let zero = f64x8::splat(simd, 0.0);
        Self { t: zero, u: zero, v: zero, den: zero, good: mask64x8::splat(simd, true) }
    }

    /// Those of `others` in some lanes.
    #[inline(always)]
    fn replace(&mut self, simd: S, lanes: u32, others: &Self) {
        let lanes = mask64x8::from_bitmask(simd, u64::from(lanes));
        self.t = lanes.select(others.t, self.t);
        self.u = lanes.select(others.u, self.u);
        self.v = lanes.select(others.v, self.v);
        self.den = lanes.select(others.den, self.den);
        self.good = (lanes & others.good) | (!lanes & self.good);
    }

    #[inline(always)]
    fn put(&self, simd: S, wanted: u32, ids: &[u32; 8], first: usize, hits: &mut HitArrays) {
        let (zero, infinity) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, f64::INFINITY));
        let wanted = mask64x8::from_bitmask(simd, u64::from(wanted));
        let room = first..first + 8;
        hits.primitive_id[room.clone()].copy_from_slice(ids);
        wanted.select(self.t, infinity).store_slice(&mut hits.t[room.clone()]);
        wanted.select(self.u, zero).store_slice(&mut hits.u[room.clone()]);
        wanted.select(self.v, zero).store_slice(&mut hits.v[room.clone()]);
        let front = (wanted & self.den.simd_gt(0.0)).to_bitmask();
        for (lane, is_front) in hits.is_front[room].iter_mut().enumerate() {
            *is_front = front >> lane & 1 == 1;
        }
    }
}

#[inline(always)]
fn difference<S: Lanes>(a: Vector<S>, b: Vector<S>) -> Vector<S> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn cross<S: Lanes>(a: Vector<S>, b: Vector<S>) -> Vector<S> {
    [a[1] * b[2] - b[1] * a[2], a[2] * b[0] - b[2] * a[0], a[0] * b[1] - b[0] * a[1]]
}

#[inline(always)]
fn dot<S: Lanes>(a: Vector<S>, b: Vector<S>) -> f64x8<S> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn largest<S: Lanes>(v: Vector<S>) -> f64x8<S> {
    v[0].abs().max(v[1].abs()).max(v[2].abs())
}
