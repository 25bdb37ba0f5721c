//! Rays that have something in common, for packets.

use kdray::{Aabb, Ray};
use rand::{Rng, RngExt};

/// How many rays a bundle has: not a whole packet of any size.
const RAYS: usize = 75;

/// Three bundles around a ray, which is one of each: of its origin, of its direction, and of its
/// point at t = 1. How wide they are is a matter of chance, from nothing to beyond `bounds`.
pub fn bundles(ray: &Ray, bounds: &Aabb<3>, random: &mut impl Rng) -> [Vec<Ray>; 3] {
    let width = 10.0_f64.powi(random.random_range(-12..=1));
    let length = ray.direction.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
    let end = ray.at(1.0);
    let fan = of(ray, || Ray { direction: moved(ray.direction, width * length, random), ..*ray });
    let aside = width * bounds.diagonal();
    let sheaf = of(ray, || Ray { origin: moved(ray.origin, aside, random), ..*ray });
    let closing = of(ray, || {
        let to_end = Ray::through(moved(ray.origin, width * length, random), end);
        to_end.with_interval(0.0, 1.0)
    });
    [fan, sheaf, closing]
}

fn of(first: &Ray, others: impl FnMut() -> Ray) -> Vec<Ray> {
    std::iter::once(*first).chain(std::iter::repeat_with(others).take(RAYS - 1)).collect()
}

/// A point nearby, on some axes the same.
fn moved(p: [f64; 3], by: f64, random: &mut impl Rng) -> [f64; 3] {
    p.map(
        |x| {
            if random.random_range(0..4) == 0 { x } else { x + by * random.random_range(-1.0..1.0) }
        },
    )
}
