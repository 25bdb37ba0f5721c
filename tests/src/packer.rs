//! Packets of rays that are hard on purpose. All are seeded: the same on every run.

use crate::owned_packet::OwnedPacket;
use crate::rays::{Archer, random};
use kdray::geometry::{Common, tile_order};
use kdray::{Coordinate, KdTree, Ray, TriangleMesh};
use rand::RngExt;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64Mcg;

/// How many rays packets have: one, few, what fills vectors and packets of the kernels, one fewer and
/// one more, and several packets.
const COUNTS: [usize; 8] = [1, 3, 8, 64, 255, 256, 257, 1000];

/// Makes packets at the triangles of one case.
///
/// A packet is a place and points: the rays go from the place through the points, or from the points to
/// the place, or through the points in the direction of the place.
pub struct Packer<'a, T: 'static = f32> {
    archer: Archer<'a, TriangleMesh<T>, 3>,
    aimed: &'a [Ray],
    random: Pcg64Mcg,
}

impl<'a, T: Coordinate> Packer<'a, T> {
    /// Packets at `mesh`, which some rays were aimed at.
    pub fn new(mesh: &'a TriangleMesh<T>, aimed: &'a [Ray], seed: u64) -> Self {
        Self { archer: Archer::new(mesh, seed), aimed, random: random(seed) }
    }

    /// The same at a mesh whose [extent](crate::Subject::extent) is known.
    pub fn within(
        mesh: &'a TriangleMesh<T>,
        extent: ([f64; 3], [f64; 3]),
        aimed: &'a [Ray],
        seed: u64,
    ) -> Self {
        Self { archer: Archer::within(mesh, extent, seed), aimed, random: random(seed) }
    }

    /// Packets of every kind and size, `each` of them; places are up to `farthest` diagonals away.
    pub fn all_kinds(&mut self, each: usize, farthest: f64) -> Vec<OwnedPacket> {
        if self.archer.is_at_nothing() {
            return self.of([0.0; 3], &[[1.0, 2.0, 3.0]]).into();
        }
        let mut packets = Vec::new();
        for round in 0..each {
            for count in COUNTS {
                // Many rays, of the same kinds as fewer, only once.
                if count > 300 && round > 0 {
                    continue;
                }
                packets.extend(self.at_points(count, farthest));
            }
        }
        packets
    }

    /// Packets of that many rays from or to a place around the triangles, through any points among them:
    /// not hard at all.
    pub fn at_random(&mut self, count: usize) -> [OwnedPacket; 3] {
        let place = self.archer.around(1.0);
        let points: Vec<_> = (0..count).map(|_| self.archer.around(0.1)).collect();
        let directions: Vec<_> = points.iter().map(|&point| minus(point, place)).collect();
        let direction = minus(self.archer.around(0.0), place);
        let origins: Vec<_> = points.iter().map(|&point| minus(point, direction)).collect();
        [
            OwnedPacket::new(Common::Origin(place), &directions),
            OwnedPacket::new(Common::Direction(direction), &origins),
            OwnedPacket::new(Common::Target(place), &points),
        ]
    }

    /// Packets with rays in the split planes of `tree`, and in two or more of them at once.
    pub fn in_split_planes(&mut self, tree: &KdTree<3>, count: usize) -> Vec<OwnedPacket> {
        let splits = self.archer.splits(tree);
        if splits.is_empty() {
            return Vec::new();
        }
        let mut packets = Vec::new();
        for _ in 0..count {
            let mut place = self.archer.around(0.3);
            let mut points = self.points(64, place);
            for _ in 0..2 {
                let (axis, plane) = splits[self.random.random_range(0..splits.len())];
                place[axis] = plane;
                points.iter_mut().step_by(2).for_each(|point| point[axis] = plane);
            }
            packets.extend(self.of(place, &points));
        }
        packets
    }

    /// A packet of each kind of [`Common`], of that many rays.
    pub fn at_points(&mut self, count: usize, farthest: f64) -> [OwnedPacket; 3] {
        let place = self.place(farthest);
        let mut points = self.points(count, place);
        if self.random.random_range(0..3) == 0 {
            self.spoil(place, &mut points);
        }
        self.of(place, &points)
    }

    fn of(&mut self, place: [f64; 3], points: &[[f64; 3]]) -> [OwnedPacket; 3] {
        let directions: Vec<_> = points.iter().map(|&p| self.stretched(minus(p, place))).collect();
        let direction = if self.archer.is_at_nothing() { [1.0; 3] } else { self.direction(place) };
        let back = self.random.random_range(-1..=1);
        let behind = |&p: &[f64; 3]| minus(p, direction.map(|d| f64::from(back) * d));
        let origins: Vec<_> = points.iter().map(behind).collect();
        [
            OwnedPacket::new(Common::Origin(place), &directions),
            OwnedPacket::new(Common::Direction(direction), &origins),
            OwnedPacket::new(Common::Target(place), points),
        ]
    }

    /// A place: on a vertex, an edge or a triangle's plane, among or around the triangles, far away, or
    /// where another ray begins.
    fn place(&mut self, farthest: f64) -> [f64; 3] {
        match self.random.random_range(0..8) {
            0 => self.archer.corner(),
            1 => self.edge_middle(),
            2 => self.in_a_plane(),
            3 => self.archer.around(0.0).map(|x| self.archer.rounded(x)),
            4 => self.archer.point_afar(farthest),
            5 => self.aimed.choose(&mut self.random).map_or([0.0; 3], |ray| ray.origin),
            _ => self.archer.around(1.0).map(|x| self.archer.rounded(x)),
        }
    }

    /// The direction to a place, or a special one.
    fn direction(&mut self, place: [f64; 3]) -> [f64; 3] {
        let mut direction = match self.random.random_range(0..5) {
            0 => self.aimed.choose(&mut self.random).map_or([1.0; 3], |ray| ray.direction),
            1 => {
                let (a, b) = self.archer.edge();
                minus(b, a)
            }
            2 => minus(self.in_a_plane(), self.in_a_plane()),
            _ => minus(self.archer.around(0.0), place),
        };
        let zeros = self.random.random_range(0..=3);
        direction[..zeros].fill_with(|| self.archer.zero());
        let keeps = self.random.random_range(0..3);
        if direction == [0.0; 3] && keeps > 0 {
            direction[keeps] = if self.random.random() { 1.0 } else { -1.0 };
        }
        self.stretched(direction)
    }

    /// Points that rays of a packet go through.
    fn points(&mut self, count: usize, place: [f64; 3]) -> Vec<[f64; 3]> {
        let (kind, width) = (self.random.random_range(0..12), self.width());
        match kind {
            0 => (0..count).map(|_| self.archer.corner()).collect(),
            1 => (0..count).map(|_| self.edge_middle()).collect(),
            2 => (0..count).map(|_| self.in_a_plane()).collect(),
            3 => (0..count).map(|_| self.archer.around(0.5)).collect(),
            4 => (0..count).map(|_| self.off_along_axes(place)).collect(),
            5 => self.some_of_each(count),
            _ => self.patch(count, width),
        }
    }

    /// Corners and other points next to each other.
    fn some_of_each(&mut self, count: usize) -> Vec<[f64; 3]> {
        let mut point = |index: usize| match index % 4 {
            0 => self.archer.corner(),
            1 => self.edge_middle(),
            2 => self.aimed.choose(&mut self.random).map_or([0.0; 3], |ray| ray.at(1.0)),
            _ => self.archer.around(0.1),
        };
        (0..count).map(&mut point).collect()
    }

    /// A piece of a picture around a corner or another point: pixels in the order of tiles, that many
    /// diagonals across.
    fn patch(&mut self, count: usize, width: f64) -> Vec<[f64; 3]> {
        let middle = if self.random.random() { self.archer.corner() } else { self.edge_middle() };
        let axis = self.random.random_range(0..3);
        let step = width * self.archer.size() / 32.0;
        let (across, up) = ((axis + 1) % 3, (axis + 2) % 3);
        let tilt = if self.random.random() { 0.3 } else { 0.0 };
        let pixel = |[x, y]: [u32; 2]| {
            let (x, y) = (step * (f64::from(x) - 8.0), step * (f64::from(y) - 8.0));
            let mut point = middle;
            point[across] += x;
            point[up] += y;
            point[axis] += tilt * x;
            point
        };
        tile_order(32, 32).map(pixel).take(count).collect()
    }

    /// A width in diagonals: often one that packets have, sometimes nearly nothing, or a fisheye.
    fn width(&mut self) -> f64 {
        let exponent = match self.random.random_range(0..4) {
            0 => self.random.random_range(-16.0..-3.0),
            1 => self.random.random_range(0.0..3.0),
            _ => self.random.random_range(-3.0..0.0),
        };
        10.0_f64.powf(exponent)
    }

    /// Behind, beside or before a place: the way there has zeros, of either sign for directions.
    fn off_along_axes(&mut self, place: [f64; 3]) -> [f64; 3] {
        let size = self.archer.size();
        let mut point = place;
        for axis in 0..self.random.random_range(1..=2) {
            point[(axis + self.random.random_range(0..3)) % 3] +=
                size * self.random.random_range(-2.0..2.0);
        }
        point
    }

    fn edge_middle(&mut self) -> [f64; 3] {
        let (a, b) = self.archer.edge();
        std::array::from_fn(|k| 0.5 * (a[k] + b[k]))
    }

    /// A point in the plane of a triangle: in it, or at a multiple of its sides.
    fn in_a_plane(&mut self) -> [f64; 3] {
        let corners = self.archer.corners();
        let (a, b, c) = (corners[0], corners[1], corners[2]);
        let mut whole = || f64::from(self.random.random_range(-4..=8)) * 0.25;
        let (s, t) = (whole(), whole());
        std::array::from_fn(|k| a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]))
    }

    /// A direction that is as it was, turned around, or very long or short.
    fn stretched(&mut self, direction: [f64; 3]) -> [f64; 3] {
        let factor = match self.random.random_range(0..40) {
            0 => -1.0,
            1 => 2.0_f64.powi(self.random.random_range(-60..60)),
            _ => 1.0,
        };
        direction.map(|d| d * factor)
    }

    /// Makes some rays such that nothing hits them: without direction, or of numbers that are none.
    fn spoil(&mut self, place: [f64; 3], points: &mut [[f64; 3]]) {
        for point in points {
            match self.random.random_range(0..12) {
                0 => *point = place,
                1 => point[self.random.random_range(0..3)] = f64::NAN,
                2 => point[self.random.random_range(0..3)] = f64::INFINITY,
                3 => point[self.random.random_range(0..3)] = -1e300,
                _ => {}
            }
        }
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}
