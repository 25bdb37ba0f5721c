//! A fast answer without a tree: every triangle is considered for every ray.
//!
//! Triangles stand in a flat list, neighbours in space near each other, in blocks with a bounding
//! sphere. A ray passes over a block only if its line stays clear of the sphere by far more than
//! rounding can explain; every triangle of every other block is put to kdray's own test. Nothing
//! of kdray's trees, boxes and traversals is used.

use kdray::primitives::{HitRule, intersect_triangle};
use kdray::{Coordinate, Hit, Ray, TriangleMesh};

/// How many triangles share a bounding sphere, and how many spheres a larger one.
const BLOCK: usize = 16;

/// What distances may lose whose squares underflow.
const UNDERFLOW: f64 = 1e-150;

/// Sizes whose products of three neither over- nor underflow. Spheres around meshes of other sizes are scaled.
const SIZES: std::ops::Range<f64> = 1e-45..1e45;

/// A mesh laid out for testing all its triangles.
pub struct Flat<T = f32> {
    triangles: Vec<([[T; 3]; 3], u32)>,
    /// The power of two that makes the largest coordinate one to two, if it is out of the ordinary; else one.
    scale: f64,
    /// The spheres around each [`BLOCK`] triangles, scaled.
    spheres: Vec<Sphere>,
    /// The spheres around each [`BLOCK`] spheres.
    outer_spheres: Vec<Sphere>,
}

#[derive(Clone, Copy)]
struct Sphere {
    center: [f64; 3],
    radius: f64,
}

impl<T: Coordinate> Flat<T> {
    /// Lays out a mesh.
    pub fn new(mesh: &TriangleMesh<T>) -> Self {
        let ids = 0..mesh.triangles().len() as u32;
        let mut triangles: Vec<_> = ids.map(|id| (mesh.corners(id), id)).collect();
        let corners = triangles.iter().flat_map(|(corners, _)| corners.as_flattened());
        let scale = scale_of(corners.fold(0.0, |most, x| most.max(x.to_f64().abs())));
        let scaled = |p: &[T; 3]| p.map(|x| x.to_f64() * scale);
        let middle = |corners: &[[T; 3]; 3]| {
            let sum = |k: usize| corners.iter().map(|p| scaled(p)[k]).sum::<f64>() / 3.0;
            [sum(0), sum(1), sum(2)]
        };
        let (min, max) = ends(triangles.iter().map(|(corners, _)| middle(corners)));
        triangles.sort_by_cached_key(|(corners, id)| (z_order(middle(corners), min, max), *id));
        let spheres: Vec<_> = triangles
            .chunks(BLOCK)
            .map(|block| {
                let corners = block.iter().flat_map(|(corners, _)| corners);
                Sphere::around(corners.map(|p| (scaled(p), 0.0)))
            })
            .collect();
        let outer_spheres = spheres
            .chunks(BLOCK)
            .map(|block| Sphere::around(block.iter().map(|s| (s.center, s.radius))))
            .collect();
        Self { triangles, scale, spheres, outer_spheres }
    }

    /// The power of two that makes the largest coordinate one to two, if it is out of the ordinary; else one.
    pub(crate) fn scale(&self) -> f64 {
        self.scale
    }

    /// The hit of least t; of several at the same t, the one of the smallest id.
    pub fn closest_hit(&self, ray: &Ray<3>) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        self.each_candidate(ray, |corners, id| {
            let hit = intersect_triangle(corners, id, ray, HitRule::Touching);
            best = match (best, hit) {
                (Some(best), Some(hit)) if best.precedes(&hit) => Some(best),
                (best, hit) => hit.or(best),
            };
        });
        best
    }

    /// All hits that count by `rule`, in order.
    pub fn all_hits(&self, ray: &Ray<3>, rule: HitRule) -> Vec<Hit> {
        let mut hits = Vec::new();
        self.each_candidate(ray, |corners, id| {
            hits.extend(intersect_triangle(corners, id, ray, rule));
        });
        hits.sort_by(Hit::order);
        hits
    }

    /// Gives `look` the corners and ids of all triangles that the line of `ray` may meet, and of others.
    pub(crate) fn each_candidate(&self, ray: &Ray<3>, look: impl FnMut(&[[T; 3]; 3], u32)) {
        let line = Line::of(ray, self.scale);
        self.each_where(|sphere| !line.is_clear_of(sphere), look);
    }

    /// Gives `look` the corners and ids of all triangles that may be as near to `point` as it last answered, and
    /// of others.
    pub(crate) fn each_near(
        &self,
        point: [f64; 3],
        mut look: impl FnMut(&[[T; 3]; 3], u32) -> f64,
    ) {
        let center = point.map(|x| x * self.scale);
        let reach = std::cell::Cell::new(f64::INFINITY);
        let is_near = |sphere: &Sphere| {
            let to_center = distance(sphere.center, center);
            // Not if any of it is NaN or has overflowed.
            let is_far = to_center * (1.0 - 1e-9) - sphere.radius > reach.get() * self.scale;
            !(is_far && to_center < 1e150)
        };
        self.each_where(is_near, |corners, id| reach.set(look(corners, id)));
    }

    fn each_where(
        &self,
        is_wanted: impl Fn(&Sphere) -> bool,
        mut look: impl FnMut(&[[T; 3]; 3], u32),
    ) {
        for (outer, outer_sphere) in self.outer_spheres.iter().enumerate() {
            if !is_wanted(outer_sphere) {
                continue;
            }
            for inner in chunk(outer, self.spheres.len()) {
                if !is_wanted(&self.spheres[inner]) {
                    continue;
                }
                for (corners, id) in &self.triangles[chunk(inner, self.triangles.len())] {
                    look(corners, *id);
                }
            }
        }
    }
}

fn scale_of(largest: f64) -> f64 {
    if largest == 0.0 || SIZES.contains(&largest) {
        return 1.0;
    }
    // The largest f64 has the exponent 1023, and 2^-1023 has few digits, but its own.
    let exponent = largest.log2().floor().clamp(-1022.0, 1022.0);
    2.0_f64.powi(-exponent as i32)
}

/// The places of block `index` in a list of `len`.
fn chunk(index: usize, len: usize) -> std::ops::Range<usize> {
    index * BLOCK..len.min((index + 1) * BLOCK)
}
/// The smallest and largest coordinates of points.
fn ends(points: impl Iterator<Item = [f64; 3]>) -> ([f64; 3], [f64; 3]) {
    let none = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    points.fold(none, |(min, max), p| {
        let lower = std::array::from_fn(|k| min[k].min(p[k]));
        (lower, std::array::from_fn(|k| max[k].max(p[k])))
    })
}

/// Morton's order (1966): the bits of the three coordinates in turn, 20 of each.
fn z_order(p: [f64; 3], min: [f64; 3], max: [f64; 3]) -> u64 {
    let place = |k: usize| {
        let extent = (max[k] - min[k]).max(f64::MIN_POSITIVE);
        ((p[k] - min[k]) / extent * f64::from((1 << 20) - 1)) as u64
    };
    let places = [place(0), place(1), place(2)];
    (0..60).fold(0, |key, bit| key | (places[bit % 3] >> (bit / 3) & 1) << bit)
}

impl Sphere {
    /// A sphere around spheres, grown by far more than its own rounding.
    fn around(spheres: impl Iterator<Item = ([f64; 3], f64)> + Clone) -> Self {
        let (min, max) = ends(spheres.clone().map(|(center, _)| center));
        let center: [f64; 3] = std::array::from_fn(|k| 0.5 * (min[k] + max[k]));
        let reach = spheres.map(|(p, radius)| distance(p, center) + radius);
        let largest = center.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let radius = reach.fold(0.0, f64::max) * (1.0 + 1e-9) + 1e-12 * largest + UNDERFLOW;
        Self { center, radius }
    }
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f64>().sqrt()
}

/// The line of a ray, its direction of length one.
struct Line {
    origin: [f64; 3],
    direction: [f64; 3],
}

impl Line {
    /// Of a direction of zeros, one of NaN, which is clear of nothing.
    fn of(ray: &Ray<3>, scale: f64) -> Self {
        let largest = ray.direction.iter().fold(0.0_f64, |most, d| most.max(d.abs()));
        let direction = ray.direction.map(|d| d / largest);
        let length = distance(direction, [0.0; 3]);
        let origin = ray.origin.map(|x| x * scale);
        Self { origin, direction: direction.map(|d| d / length) }
    }

    /// Whether the line surely passes the sphere by. The distance of its centre from the line errs
    /// by less than 2^-48 of its distance from the origin. Never true if anything is NaN.
    #[inline]
    fn is_clear_of(&self, sphere: &Sphere) -> bool {
        let [x, y, z]: [f64; 3] = std::array::from_fn(|k| sphere.center[k] - self.origin[k]);
        let [a, b, c] = self.direction;
        let (i, j, k) = (y * c - z * b, z * a - x * c, x * b - y * a);
        let doubt = 1e-14 * (x.abs() + y.abs() + z.abs());
        let radius = sphere.radius + doubt;
        i * i + j * j + k * k > radius * radius * (1.0 + 1e-9)
    }
}
