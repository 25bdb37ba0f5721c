//! Where volleys come from and go to. All are seeded: the same on every run.

use super::{Target, Truth, Volley, volley::SIZE};
use crate::flat::Flat;
use crate::rays::{Archer, random};
use crate::{OwnedPacket, Packer};
use kdray::geometry::Common;
use kdray::{Coordinate, Interval, Precision, Ray, Scene};
use rand::RngExt;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64Mcg;
use std::ops::Range;

/// How far away rays begin, in diagonals.
const FAR: f64 = 1e5;

/// How far away the farthest begin. From there hardly any triangle is clear of a ray, and each is decided by
/// exact arithmetic: so they are few, and only at few triangles.
const FARTHEST: f64 = 1e12;

const FEW_TRIANGLES: usize = 1000;
const FEW_RAYS: usize = 4;

/// How far away the kernels give rays up, in diagonals, more or less: 2^20 times the tree's reach.
const GIVEN_UP: Range<f64> = 1e6..1e8;
const SOME_RAYS: usize = 16;

/// Directions from the first to the second are ordinary.
const ORDINARY: Range<f64> = 1e-30..1e30;

/// Directions from the first to the second are halved so often now and then: f64 ends before t is 2^1024.
const TO_THE_END: Range<i32> = 1016..1028;

/// How many points in the inside of a closed mesh are sought.
const INSIDE: usize = 64;

/// Of so many volleys one is also put to who is slow. It shares no factor with [`KINDS`], so that all kinds have
/// their turn.
const SLOW: u64 = 11;

/// After so many volleys all kinds were made once.
const KINDS: u64 = 60;

/// What kind of volley has a number: in steps of seven, so that few volleys in a row are of many kinds.
pub(super) fn kind(number: u64) -> u64 {
    number % KINDS * 7 % KINDS
}

/// Where the rays of a volley begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum From {
    Outside,
    Inside,
    Surface,
    Afar,
}

/// What they are aimed at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum At {
    Vertex,
    EdgeMiddle,
    Edge,
    Face,
}

/// What they share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Share {
    Origin,
    Target,
    Direction,
}

/// What is made of the length of directions.
#[derive(Clone, Copy, Debug)]
enum Length {
    /// Targets are at t = 1.
    AsItIs,
    /// The kernels take them.
    Ordinary,
    /// Hits are where f64 ends.
    Halved(i32),
}

/// Makes volleys at a target.
pub struct Gunner<'a, T: 'static = f32> {
    target: &'a Target<T>,
    inside: Vec<[f64; 3]>,
    seed: u64,
}

impl<'a, T: Precision> Gunner<'a, T> {
    /// Looks for points inside, if the target is closed: such that two rays in any directions cross it an
    /// odd number of times.
    pub fn new(target: &'a Target<T>, flat: &Flat<T>, seed: u64) -> Self {
        let mut gunner = Self { target, inside: Vec::new(), seed };
        if target.is_closed {
            let mut archer = Archer::within(&target.mesh, target.extent.ends(), seed);
            let places = std::iter::repeat_with(|| archer.around(0.0).map(|x| target.rounded(x)))
                .take(20 * INSIDE);
            let mut random = random(seed);
            let inside = places.filter(|&place| is_inside(flat, place, &mut random));
            gunner.inside = inside.take(INSIDE).collect();
        }
        gunner
    }

    /// The volley of a number, at the mesh of `scene`. The tree is only used to aim.
    ///
    /// Four fifths of all volleys come from one of four places, at one of four kinds of points, and share
    /// one of three things; the others are those of [`Packer`] and [`Archer`].
    pub fn volley(&self, number: u64, scene: &Scene<T>) -> Volley {
        let seed = self.seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(number);
        let mut random = random(seed);
        let number = number + self.target.first;
        let (cycle, kind) = (number / KINDS, kind(number));
        if kind >= 48 {
            let volley = self.special(kind, scene, seed, &mut random);
            return Volley { to_the_slow: number.is_multiple_of(SLOW), ..volley };
        }
        let from = [From::Outside, From::Inside, From::Surface, From::Afar][kind as usize % 4];
        let at = [At::Vertex, At::EdgeMiddle, At::Edge, At::Face][kind as usize / 4 % 4];
        let share = [Share::Origin, Share::Target, Share::Direction][kind as usize / 16];
        // Of the twelve kinds at the same points each takes the next ones, so that all have their turn.
        let turn = cycle * 12 + kind % 4 + 4 * (kind / 16);
        let most = self.target.extent.most();
        let (far, count) = match (cycle + kind / 4) % 4 {
            0 if from == From::Afar && self.farthest() > FAR => (1.0..FARTHEST, FEW_RAYS),
            1 if from == From::Afar && self.farthest() > FAR => (GIVEN_UP, SOME_RAYS),
            _ => (1.0..FAR.min(most), SIZE),
        };
        let mut point = |i: usize| self.point(at, turn as usize * SIZE + i, &mut random);
        let points: Vec<[f64; 3]> = (0..count).map(&mut point).collect();
        let volley = self.aimed((from, far), share, &points, &mut random);
        let to_the_slow = number.is_multiple_of(SLOW);
        let volley = Volley { to_the_slow, ..volley };
        if random.random_range(0..4) == 0 {
            cut_at_hits(volley, scene, &mut random)
        } else {
            volley
        }
    }

    /// Points on edges and in faces are rounded, and so lie beside them.
    fn point(&self, at: At, number: usize, random: &mut Pcg64Mcg) -> [f64; 3] {
        let Target { mesh, vertices, edges, .. } = self.target;
        let vertex = |v: u32| self.target.vertex(v);
        let between = |(a, b): (u32, u32), s: f64| {
            let (a, b) = (vertex(a), vertex(b));
            std::array::from_fn(|k| a[k] + s * (b[k] - a[k]))
        };
        match at {
            At::Vertex => vertex(vertices[number % vertices.len()]),
            At::EdgeMiddle => between(edges[number % edges.len()], 0.5),
            At::Edge => between(edges[number % edges.len()], random.random()),
            At::Face => {
                let [a, b, c] = mesh.triangles()[number % mesh.triangles().len()].map(vertex);
                let (s, t): (f64, f64) = (random.random(), random.random());
                let (s, t) = if s + t > 1.0 { (1.0 - s, 1.0 - t) } else { (s, t) };
                std::array::from_fn(|k| a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]))
            }
        }
    }

    fn aimed(
        &self,
        (from, far): (From, Range<f64>),
        share: Share,
        points: &[[f64; 3]],
        random: &mut Pcg64Mcg,
    ) -> Volley {
        let place = |random: &mut Pcg64Mcg| self.origin(from, &far, random);
        let length = match random.random_range(0..160) {
            0..80 => Length::AsItIs,
            80..159 => Length::Ordinary,
            _ => Length::Halved(random.random_range(TO_THE_END)),
        };
        let of_length = |d: [f64; 3]| match length {
            Length::AsItIs => d,
            Length::Ordinary => of_ordinary_length(d),
            Length::Halved(times) => times_power_of_two(d, -times),
        };
        let packet = match share {
            Share::Origin => {
                let origin = place(random);
                let directions: Vec<_> =
                    points.iter().map(|&p| of_length(minus(p, origin))).collect();
                OwnedPacket::new(Common::Origin(origin), &directions)
            }
            Share::Target => {
                let origins: Vec<_> = points.iter().map(|_| place(random)).collect();
                let packet = OwnedPacket::new(Common::Target(points[0]), &origins);
                // Half of them end at the target, the others cross the whole mesh.
                match random.random() {
                    true => packet.with_interval(Interval::FORWARD),
                    false => packet,
                }
            }
            Share::Direction => {
                let direction = self.direction(minus(points[0], place(random)), random);
                let back = if from == From::Surface { 0.0 } else { 1.0 };
                let behind = |&p: &[f64; 3]| minus(p, direction.map(|d| back * d));
                let origins: Vec<_> = points.iter().map(behind).collect();
                OwnedPacket::new(Common::Direction(of_length(direction)), &origins)
            }
        };
        let from_inside = from == From::Inside && share != Share::Direction;
        Volley { from_inside: from_inside && !self.inside.is_empty(), ..Volley::of_packet(packet) }
    }

    /// Where a ray begins: on the surface if there is no inside.
    fn origin(&self, from: From, far: &Range<f64>, random: &mut Pcg64Mcg) -> [f64; 3] {
        let mut archer =
            Archer::within(&self.target.mesh, self.target.extent.ends(), random.random());
        match (from, self.inside.choose(random)) {
            (From::Outside, _) => self.outside(random),
            // Most of them of so few digits that the way to a vertex is not rounded.
            (From::Afar, _) => match random.random_range(0..4) {
                0 => archer.point_between(far.clone()),
                _ => archer.point_between(far.clone()).map(of_few_digits),
            },
            (From::Inside, Some(&place)) => place,
            _ => {
                let at = [At::Vertex, At::EdgeMiddle, At::Face][random.random_range(0..3)];
                self.point(at, random.random_range(0..usize::MAX / 2), random)
            }
        }
    }

    /// A point outside of the box: a little, far, or above the middle of a side. In f32, so that the
    /// direction to a vertex is not rounded, unless it is far.
    fn outside(&self, random: &mut Pcg64Mcg) -> [f64; 3] {
        let extent = &self.target.extent;
        let (center, size) = (extent.center(), extent.size());
        let is_aligned = random.random_range(0..10) == 0;
        let mut point: [f64; 3] = std::array::from_fn(|k| {
            let offset = if is_aligned { 0.0 } else { random.random_range(-1.0..1.0) };
            center[k] + size[k] * offset
        });
        let axis = random.random_range(0..3);
        let distance = [0.51, 0.75, 1.0, 2.0, 10.0][random.random_range(0..5)];
        let sign = if random.random() { 1.0 } else { -1.0 };
        point[axis] = center[axis] + sign * distance * extent.diagonal();
        point.map(|x| self.target.rounded(x))
    }

    /// The direction, or one along an axis, in a plane of two axes, or longer or shorter.
    fn direction(&self, direction: [f64; 3], random: &mut Pcg64Mcg) -> [f64; 3] {
        let zero = if random.random() { 0.0 } else { -0.0 };
        let axis = random.random_range(0..3);
        let mut direction = direction;
        match random.random_range(0..6) {
            0 | 1 => {
                let length = self.target.extent.diagonal().max(f64::MIN_POSITIVE);
                direction = [zero; 3];
                direction[axis] = if random.random() { length } else { -length };
            }
            2 => direction[axis] = zero,
            3 => direction = times_power_of_two(direction, random.random_range(-60..60)),
            _ => {}
        }
        direction
    }

    /// How far away the farthest rays begin.
    fn farthest(&self) -> f64 {
        let is_small = self.target.mesh.triangles().len() <= FEW_TRIANGLES;
        let farthest = if is_small { FARTHEST } else { FAR };
        if farthest <= self.target.extent.most() {
            farthest
        } else {
            FAR.min(self.target.extent.most())
        }
    }

    /// Packets of every kind, packets in split planes, and single rays of every kind.
    fn special(&self, kind: u64, scene: &Scene<T>, seed: u64, random: &mut Pcg64Mcg) -> Volley {
        let Target { mesh, extent, .. } = self.target;
        let far = FAR.min(self.target.extent.most());
        let aimed = Archer::within(mesh, extent.ends(), seed).all_kinds(2, far);
        let mut packer = Packer::within(mesh, extent.ends(), &aimed, seed);
        let count = [1, 7, 64, 65, 130, 520][random.random_range(0..6)];
        let packets: Vec<OwnedPacket> = match kind % 3 {
            0 => packer.at_points(count, far).into(),
            1 => packer.in_split_planes(scene.tree(), 1),
            _ => Vec::new(),
        };
        if let Some(packet) = packets.choose(random) {
            return cut_at_hits(Volley::of_packet(packet.clone()), scene, random);
        }
        let mut archer = Archer::within(mesh, extent.ends(), seed);
        let mut rays = archer.all_kinds(4, self.farthest());
        rays.extend(archer.in_split_planes(scene.tree(), 12));
        let cut: Vec<Ray> = rays.iter().map(|ray| cut(ray, scene, random)).collect();
        Volley::of_rays([rays, cut].concat())
    }
}

/// Whether two rays in any directions from there, which is not on a triangle, cross the triangles an odd number of times.
pub(crate) fn is_inside<T: Coordinate>(
    flat: &Flat<T>,
    place: [f64; 3],
    random: &mut Pcg64Mcg,
) -> bool {
    let mut crosses = || {
        let direction = [0; 3].map(|_| random.random_range(-1.0..1.0));
        let truth = Truth::of(flat, &Ray::new(place, direction));
        let (least, most) = truth.count(Interval::FORWARD);
        // On the surface the number depends on where the ray goes.
        let is_off_surface = truth.touched.iter().all(|hit| hit.t != 0.0);
        is_off_surface && least == most && least % 2 == 1
    };
    crosses() && crosses()
}

/// The same rays, each with an interval that begins or ends exactly at a hit, or a step beside it.
fn cut_at_hits<T: Precision>(volley: Volley, scene: &Scene<T>, random: &mut Pcg64Mcg) -> Volley {
    let rays: Vec<Ray> = volley.rays.iter().map(|ray| cut(ray, scene, random)).collect();
    let intervals: Vec<Interval> = rays.iter().map(|ray| ray.interval).collect();
    let packet = volley.packet.map(|packet| packet.with_intervals(&intervals));
    Volley { rays, packet, ..volley }
}

fn cut<T: Precision>(ray: &Ray, scene: &Scene<T>, random: &mut Pcg64Mcg) -> Ray {
    let hits: Vec<f64> = scene.shapes().all_touched(ray).take(5).map(|hit| hit.t).collect();
    let Some(&t) = hits.choose(random) else { return *ray };
    let infinite = f64::INFINITY;
    let ends = [
        (t, infinite),
        (t.next_up(), infinite),
        (0.0, t),
        (-infinite, t.next_down()),
        (t, t),
        (-infinite, infinite),
    ];
    let (t_min, t_max) = ends[random.random_range(0..ends.len())];
    ray.with_interval(t_min, t_max)
}

/// The same direction, times a power of two if it is very long or very short: the kernels leave such rays to the leaf
/// walk.
fn of_ordinary_length(direction: [f64; 3]) -> [f64; 3] {
    let largest = direction.iter().fold(0.0_f64, |most, d| most.max(d.abs()));
    if ORDINARY.contains(&largest) || !largest.is_normal() {
        return direction;
    }
    times_power_of_two(direction, -largest.log2().floor() as i32)
}

/// In two steps, for the power may be none that f64 has.
fn times_power_of_two(direction: [f64; 3], exponent: i32) -> [f64; 3] {
    let (first, rest) = (2.0_f64.powi(exponent / 2), 2.0_f64.powi(exponent - exponent / 2));
    direction.map(|d| d * first * rest)
}

/// The number without its last 29 digits: it has as many as an f32.
fn of_few_digits(x: f64) -> f64 {
    f64::from_bits(x.to_bits() >> 29 << 29)
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}
