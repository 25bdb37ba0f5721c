//! Rays that are hard on purpose. All are seeded: the same on every run.

use crate::Subject;
use kdray::{Interval, KdTree, Ray, tree::NodeKind};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// The source of all randomness in the tests.
pub fn random(seed: u64) -> Pcg64Mcg {
    Pcg64Mcg::seed_from_u64(seed)
}

/// Makes rays at the primitives of one case.
pub struct Archer<'a, S, const K: usize> {
    subject: &'a S,
    /// The least and the greatest coordinate on each axis.
    min: [f64; K],
    max: [f64; K],
    random: Pcg64Mcg,
}

impl<'a, S: Subject<K>, const K: usize> Archer<'a, S, K> {
    /// Rays at `subject`.
    pub fn new(subject: &'a S, seed: u64) -> Self {
        let (min, max) = subject.extent();
        Self { subject, min, max, random: random(seed) }
    }

    /// The same for a subject whose [extent](Subject::extent) is known.
    pub fn within(subject: &'a S, (min, max): ([f64; K], [f64; K]), seed: u64) -> Self {
        Self { subject, min, max, random: random(seed) }
    }

    /// Whether there is nothing to aim at.
    pub(crate) fn is_at_nothing(&self) -> bool {
        self.min[0] > self.max[0]
    }

    /// Rays of every kind, about `each` of a kind. Origins are up to `farthest` diagonals away.
    pub fn all_kinds(&mut self, each: usize, farthest: f64) -> Vec<Ray<K>> {
        let mut rays = Vec::new();
        if self.is_at_nothing() {
            return vec![Ray::new([0.0; K], [1.0; K])];
        }
        for _ in 0..each {
            rays.push(self.at_random());
            rays.push(self.at_a_vertex_from_afar(farthest));
            rays.push(self.at_a_vertex());
            rays.push(self.at_an_edge());
            rays.push(self.along_an_edge());
            rays.push(self.in_a_face());
            rays.push(self.parallel_to_an_axis());
            rays.push(self.off_a_surface());
            let backward = self.at_a_vertex().with_interval(-1e30, 1e30);
            rays.push(backward);
            let mut line = self.at_random();
            line.interval = Interval::LINE;
            rays.push(line);
            let of_odd_length = self.scaled();
            rays.push(of_odd_length);
        }
        rays
    }

    /// From around the primitives to a point among them.
    fn at_random(&mut self) -> Ray<K> {
        let (from, to) = (self.around(1.0), self.around(0.0));
        Ray::through(from, to)
    }

    /// From a distance of up to `farthest` diagonals, at a corner.
    fn at_a_vertex_from_afar(&mut self, farthest: f64) -> Ray<K> {
        let origin = self.point_afar(farthest);
        Ray::through(origin, self.corner())
    }

    /// A point at a distance of up to `farthest` diagonals.
    pub(crate) fn point_afar(&mut self, farthest: f64) -> [f64; K] {
        self.point_between(1.0..farthest)
    }

    /// A point at a distance in that range, in diagonals.
    pub(crate) fn point_between(&mut self, distances: std::ops::Range<f64>) -> [f64; K] {
        let exponents = distances.start.log10()..=distances.end.log10();
        let exponent = self.random.random_range(exponents);
        let scale = 10.0_f64.powf(exponent) * self.size();
        std::array::from_fn(|_| self.random.random_range(-scale..scale))
    }

    /// Through a corner; exactly so, for the origin is an f32 of about the same size, so that the
    /// direction is an f64 without rounding.
    fn at_a_vertex(&mut self) -> Ray<K> {
        let from = self.around(1.0).map(|x| self.rounded(x));
        Ray::through(from, self.corner())
    }

    /// Through the middle between two corners.
    fn at_an_edge(&mut self) -> Ray<K> {
        let from = self.around(1.0).map(|x| self.rounded(x));
        let (a, b) = self.edge();
        Ray::through(from, std::array::from_fn(|k| 0.5 * (a[k] + b[k])))
    }

    /// In the line of two corners, from before, at, between or behind them.
    fn along_an_edge(&mut self) -> Ray<K> {
        let (a, b) = self.edge();
        let start = f64::from(self.random.random_range(-4..=4)) * 0.5;
        let origin = std::array::from_fn(|k| a[k] + start * (b[k] - a[k]));
        Ray::new(origin, std::array::from_fn(|k| b[k] - a[k]))
    }

    /// In the plane of a triangle: from a, plus multiples of its sides, along others.
    fn in_a_face(&mut self) -> Ray<K> {
        let corners = self.corners();
        let (a, b, c) = (corners[0], corners[1], corners[corners.len() - 1]);
        let mut whole = || f64::from(self.random.random_range(-3..=3));
        let (i, j, p, q) = (whole(), whole(), whole(), whole() + 0.5);
        let mix = |k: usize, s: f64, t: f64| s * (b[k] - a[k]) + t * (c[k] - a[k]);
        let origin = std::array::from_fn(|k| a[k] + mix(k, i, j));
        Ray::new(origin, std::array::from_fn(|k| mix(k, p, q)))
    }

    /// Along an axis, with zeros of either sign, through a corner or any point.
    fn parallel_to_an_axis(&mut self) -> Ray<K> {
        let through = if self.random.random() { self.corner() } else { self.around(0.0) };
        let axis = self.random.random_range(0..K);
        let mut origin = through;
        origin[axis] -= self.random.random_range(-2.0..2.0) * self.size();
        let mut direction: [f64; K] = std::array::from_fn(|_| self.zero());
        direction[axis] = if self.random.random() { 1.0 } else { -1.0 };
        Ray::new(origin, direction)
    }

    /// From a corner, the middle of an edge or a point of a surface, in any direction.
    fn off_a_surface(&mut self) -> Ray<K> {
        let corners = self.corners();
        let (a, b, c) = (corners[0], corners[1], corners[corners.len() - 1]);
        let [s, t] = [[0.0, 0.0], [0.5, 0.0], [0.25, 0.5]][self.random.random_range(0..3)];
        let origin = std::array::from_fn(|k| a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]));
        let direction = std::array::from_fn(|_| self.random.random_range(-1.0..1.0));
        Ray::new(origin, direction)
    }

    /// Through a corner, with a direction that is very long or very short.
    fn scaled(&mut self) -> Ray<K> {
        let mut ray = self.at_a_vertex();
        let factor = 2.0_f64.powi(self.random.random_range(-60..60));
        ray.direction = ray.direction.map(|d| d * factor);
        ray
    }

    /// Rays in the split planes of `tree`, and in two or more of them at once.
    pub fn in_split_planes(&mut self, tree: &KdTree<K>, count: usize) -> Vec<Ray<K>> {
        let splits = self.splits(tree);
        if splits.is_empty() {
            return Vec::new();
        }
        let mut rays = Vec::new();
        for _ in 0..count {
            let mut ray = if self.random.random() { self.at_random() } else { self.at_a_vertex() };
            for _ in 1..K {
                let (axis, plane) = splits[self.random.random_range(0..splits.len())];
                ray.origin[axis] = plane;
                ray.direction[axis] = self.zero();
            }
            rays.extend(ray.check().is_ok().then_some(ray));
        }
        rays
    }

    /// A point in the box of all primitives, grown on each side by `margin` diagonals.
    pub(crate) fn around(&mut self, margin: f64) -> [f64; K] {
        let margin = margin * self.diagonal();
        std::array::from_fn(|k| {
            self.random.random_range(self.min[k] - margin..=self.max[k] + margin)
        })
    }

    pub(crate) fn zero(&mut self) -> f64 {
        if self.random.random() { 0.0 } else { -0.0 }
    }

    /// The diagonal; the distance from zero if the box is a point.
    pub(crate) fn size(&self) -> f64 {
        let least = f64::from(f32::MIN_POSITIVE);
        let largest = self.max.iter().fold(least, |m, x| m.max(x.abs()));
        if self.diagonal() > 0.0 { self.diagonal() } else { largest }
    }

    /// The diagonal of the box around all primitives.
    fn diagonal(&self) -> f64 {
        (0..K).fold(0.0, |length, k| f64::hypot(length, self.max[k] - self.min[k]))
    }

    /// A number next to x that has few digits: see [`Subject::rounded`].
    pub fn rounded(&self, x: f64) -> f64 {
        let largest = self.min.iter().chain(&self.max).fold(0.0, |most: f64, x| most.max(x.abs()));
        S::rounded(x, largest)
    }

    /// The split planes of a tree: their axes and places.
    pub(crate) fn splits(&self, tree: &KdTree<K>) -> Vec<(usize, f64)> {
        let split = |kind: NodeKind| match kind {
            NodeKind::Inner { axis, split, .. } => Some((axis, self.subject.plane(axis, split))),
            NodeKind::Leaf { .. } => None,
        };
        tree.nodes().iter().filter_map(|node| split(node.kind())).collect()
    }

    pub(crate) fn corners(&mut self) -> Vec<[f64; K]> {
        let id = self.random.random_range(0..self.subject.count() as u32);
        self.subject.corners(id)
    }

    pub(crate) fn corner(&mut self) -> [f64; K] {
        let corners = self.corners();
        corners[self.random.random_range(0..corners.len())]
    }

    pub(crate) fn edge(&mut self) -> ([f64; K], [f64; K]) {
        let corners = self.corners();
        let first = self.random.random_range(0..corners.len());
        (corners[first], corners[(first + 1) % corners.len()])
    }
}
