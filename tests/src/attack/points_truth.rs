//! What is true of points: distances in rational arithmetic, sides by counting, and what is in the way.

use super::target::Target;
use super::truth::Place;
use super::{FEW, Truth};
use crate::flat::Flat;
use crate::oracle::{exact_distance_squared, exact_half_angle, is_between};
use glam::DVec3;
use kdray::{Coordinate, Interval, Ray, Side};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::ToPrimitive;

/// Differences, lengths, products and sums of a solid angle have fewer than thirty roundings.
const ROUNDINGS: f64 = 32.0 / (1_u64 << 53) as f64;

/// Where sine and cosine, times their common length, are both shorter than this, the angle may be off by more than a
/// millionth.
const SHORT: f64 = 1e6 * ROUNDINGS;

/// What is known of a mesh.
pub struct PointTruth<'a, T: 'static = f32> {
    target: &'a Target<T>,
    flat: &'a Flat<T>,
}

impl<'a, T: Coordinate> PointTruth<'a, T> {
    /// The truth about a target.
    pub fn new(target: &'a Target<T>, flat: &'a Flat<T>) -> Self {
        Self { target, flat }
    }

    /// The square of the distance to the nearest triangle; `None` if there is none.
    ///
    /// Triangles are left out whose box is surely farther away than one that is known.
    pub fn distance_squared(&self, point: [f64; 3]) -> Option<BigRational> {
        let mut nearest: Option<(BigRational, f64)> = None;
        let mut last = None;
        self.flat.each_near(point, |corners, _| {
            let reach = nearest.as_ref().map_or(f64::INFINITY, |(_, reach)| *reach);
            // Some meshes have the same triangle again and again.
            if last == Some(*corners) || distance_to_box(point, corners) > reach {
                return reach;
            }
            last = Some(*corners);
            let exact = exact_distance_squared(point, corners);
            if nearest.as_ref().is_some_and(|(least, _)| *least <= exact) {
                return reach;
            }
            let reach = root(&exact) * (1.0 + 1e-9) + f64::MIN_POSITIVE;
            nearest = Some((exact, reach));
            reach
        });
        nearest.map(|(exact, _)| exact)
    }

    /// Whether a point that is not on the surface is inside: by the parity of crossings where the mesh is closed,
    /// else by the winding number, unless that is too near to a half, or of too many triangles.
    pub fn contains_off_surface(&self, point: [f64; 3]) -> Option<bool> {
        if self.target.is_closed {
            return Some(self.ahead(point).count() % 2 == 1);
        }
        let number = self.winding_number(point)?;
        ((number - 0.5).abs() > 0.02).then_some(number > 0.5)
    }

    /// The sum of all solid angles, as a share of the sphere, of a point that is not on the surface; `None` if there
    /// are too many triangles.
    pub fn winding_number(&self, point: [f64; 3]) -> Option<f64> {
        let count = self.target.mesh.triangles().len();
        let seen_from = DVec3::from(point) * self.flat.scale();
        let angle = |id: u32| {
            let plain = half_angle(self.scaled(id).map(|p| p - seen_from));
            plain.unwrap_or_else(|| exact_half_angle(&self.target.mesh.corners(id), point))
        };
        let sum = || (0..count as u32).map(angle).sum::<f64>();
        Some((count <= FEW).then(sum)? / std::f64::consts::TAU)
    }

    /// The corners of a triangle, in units of which products neither over- nor underflow.
    fn scaled(&self, id: u32) -> [DVec3; 3] {
        let corner = |p: [T; 3]| DVec3::from(p.map(T::to_f64)) * self.flat.scale();
        self.target.mesh.corners(id).map(corner)
    }

    /// Whether nothing is between two points. Nothing sees across a difference that is no number.
    pub fn is_visible(&self, from: [f64; 3], to: [f64; 3]) -> bool {
        let ray = Ray { interval: Interval::LINE, ..Ray::through(from, to) };
        if !ray.direction.iter().all(|d| d.is_finite()) {
            return false;
        }
        let is_in_the_way = |id: u32| is_between(&self.target.mesh.corners(id), from, to);
        if (0..3).all(|k| is_difference_exact(to[k], from[k])) {
            let between = Interval { t_min: f64::from_bits(1), t_max: 1.0 };
            let touched = Truth::of(self.flat, &ray).touched;
            return !touched.iter().any(|hit| match hit.place(between) {
                Place::Inside => true,
                Place::AtEnd => is_in_the_way(hit.id),
                Place::Outside => false,
            });
        }
        // The ray is rounded, and tells only what is far from it.
        let mut is_free = true;
        self.flat.each_candidate(&ray, |_, id| is_free = is_free && !is_in_the_way(id));
        is_free
    }

    /// How often the mesh winds around a point that is not on it, counted: by the sides of what a ray crosses.
    /// Only of oriented meshes is that the same for every ray.
    pub fn winding_counted(&self, point: [f64; 3]) -> i64 {
        self.ahead(point).map(|side| if side == Side::Back { 1 } else { -1 }).sum()
    }

    /// The sides of the triangles that a ray from there crosses.
    fn ahead(&self, point: [f64; 3]) -> impl Iterator<Item = Side> {
        let ray = Ray { interval: Interval::LINE, ..Ray::new(point, [0.25, 0.5, 1.0]) };
        let crossed = Truth::of(self.flat, &ray).crossed;
        crossed.into_iter().filter(|hit| hit.t > 0.0).map(|hit| hit.side)
    }

    /// How far it is from a point of a triangle to the next one behind it, on the given side of its normal;
    /// `None` where the answer hangs on the last digits of the point or the normal.
    pub fn thickness(&self, id: u32, [u, v]: [f64; 2], along_normal: f64) -> Option<Option<f64>> {
        let direction = unit_normal(self.scaled(id))? * along_normal;
        let [a, b, c] = self.target.mesh.corners(id).map(|p| DVec3::from(p.map(T::to_f64)));
        let start = a + u * (b - a) + v * (c - a);
        let scale = self.flat.scale();
        // Such that t is an ordinary number.
        let ray = Ray { interval: Interval::LINE, ..Ray::new(start, direction / scale) };
        let held = self.target.mesh.corners(id);
        let is_other = |id: u32| {
            let others = self.target.mesh.corners(id);
            !held.iter().all(|corner| others.contains(corner))
        };
        let truth = Truth::of_those(self.flat, &ray, is_other);
        let doubt = self.target.extent.doubt() * scale;
        let is_doubtful = truth.touched.iter().any(|hit| {
            let normal = unit_normal(self.scaled(hit.id));
            hit.t.abs() < doubt || normal.is_none_or(|normal| normal.dot(direction).abs() < 1e-3)
        });
        let behind = truth.touched.iter().map(|hit| hit.t).filter(|&t| t > 0.0);
        let nearest = behind.min_by(f64::total_cmp).map(|t| t / scale);
        (!truth.is_close && !is_doubtful).then_some(nearest)
    }
}

/// Whether `a − b` is an f64: by what it takes to get a and b back (Knuth's TwoDiff).
pub(super) fn is_difference_exact(a: f64, b: f64) -> bool {
    let difference = a - b;
    let b_again = a - difference;
    let a_again = difference + b_again;
    difference.is_finite() && (a - a_again) + (b_again - b) == 0.0
}

/// Half the solid angle of a triangle whose corners are seen there (van Oosterom and Strackee 1983); `None` if the
/// point is so near that rounding may put it on the other side, or turn it around an edge.
fn half_angle(corners: [DVec3; 3]) -> Option<f64> {
    let [a, b, c] = corners.map(unit);
    let (volume, facing) = (a.dot(b.cross(c)), 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
    let is_sure = volume.abs() > ROUNDINGS || facing > ROUNDINGS;
    (is_sure && volume.hypot(facing) > SHORT).then(|| volume.atan2(facing))
}

/// The normal of a triangle that is not so thin that rounding turns it.
fn unit_normal([a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let normal = unit(b - a).cross(unit(c - a));
    (normal.length() > 1e-3).then(|| normal.normalize())
}

/// The same direction of length one, of a vector of any length but zero.
fn unit(v: DVec3) -> DVec3 {
    (v / v.abs().max_element()).normalize()
}

/// The square root, nearly: also of what is beyond all f64.
fn root(square: &BigRational) -> f64 {
    let half = (square.numer().bits() as i32 - square.denom().bits() as i32) / 2;
    let ordinary = square * BigRational::from(BigInt::from(4)).pow(-half);
    let root = ordinary.to_f64().unwrap_or(f64::INFINITY).sqrt();
    root * 2.0_f64.powi(half / 2) * 2.0_f64.powi(half - half / 2)
}

/// A distance that is not above that of the triangle's box.
fn distance_to_box<T: Coordinate>(point: [f64; 3], corners: &[[T; 3]; 3]) -> f64 {
    let off = |k: usize| {
        let [a, b, c] = corners.map(|p| p[k].to_f64());
        (a.min(b).min(c) - point[k]).max(point[k] - a.max(b).max(c)).max(0.0)
    };
    off(0).hypot(off(1)).hypot(off(2)) * (1.0 - 1e-12)
}
