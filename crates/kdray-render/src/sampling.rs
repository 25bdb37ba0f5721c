//! Random numbers that depend on nothing but the seed, the pixel and what they are for.
//!
//! The points of one pixel are *correlated multi-jittered* (Kensler, "Correlated Multi-Jittered
//! Sampling", Pixar TM 13-01, 2013): for any number of points, also none that is a square, they
//! are stratified in the plane and on both axes, and each is computed from its index alone.

use glam::DVec3;
use std::f64::consts::TAU;

/// The random numbers of one camera ray.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sampler {
    /// Differs from pixel to pixel, and from purpose to purpose along the ray's tree.
    pattern: u32,
    /// Which of the pixel's rays this is.
    sample: u32,
    /// How many rays the pixel has.
    samples: u32,
}

impl Sampler {
    /// The numbers of ray `sample` of `samples` through pixel (x, y).
    pub(crate) fn new(seed: u64, [x, y]: [usize; 2], sample: u32, samples: u32) -> Self {
        let words = [seed as u32, (seed >> 32) as u32, x as u32, y as u32];
        Self { pattern: words.into_iter().fold(0x9e37_79b9, mix), sample, samples }
    }

    /// The numbers for another `purpose`, independent of these.
    pub(crate) fn fork(self, purpose: u32) -> Self {
        Self { pattern: mix(self.pattern, purpose), ..self }
    }

    /// Point `index` of `count` in the unit square; the points of all the pixel's rays together
    /// are stratified.
    pub(crate) fn point(self, index: u32, count: u32) -> [f64; 2] {
        let all = self.samples.saturating_mul(count);
        correlated_multi_jittered(self.sample * count + index, all, self.pattern)
    }
}

/// A unit vector around +z, denser towards it as the cosine (Malley's method, pbrt section 13.6.3).
pub(crate) fn cosine_hemisphere([u, v]: [f64; 2]) -> DVec3 {
    let (sin, cos) = (TAU * v).sin_cos();
    let radius = u.sqrt();
    DVec3::new(radius * cos, radius * sin, (1.0 - u).max(0.0).sqrt())
}

/// Two unit vectors that make a right-handed basis with the unit vector `n` (Duff and others,
/// "Building an Orthonormal Basis, Revisited", JCGT 2017).
pub(crate) fn tangents(n: DVec3) -> (DVec3, DVec3) {
    let sign = 1f64.copysign(n.z);
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    let x = DVec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
    (x, DVec3::new(b, sign + n.y * n.y * a, -n.y))
}

/// Hashes two words into one (the finisher of MurmurHash3 over their combination).
fn mix(a: u32, b: u32) -> u32 {
    let mut h = a ^ b.wrapping_mul(0xcc9e_2d51).rotate_left(15).wrapping_mul(0x1b87_3593);
    h = h.rotate_left(13).wrapping_mul(5).wrapping_add(0xe654_6b64);
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    h ^ (h >> 16)
}

/// Kensler's listing for any number of points.
fn correlated_multi_jittered(index: u32, count: u32, pattern: u32) -> [f64; 2] {
    let columns = f64::from(count).sqrt() as u32;
    let rows = count.div_ceil(columns);
    let salted = |salt: u32| pattern.wrapping_mul(salt);
    let s = permute(index, count, salted(0x5163_3e2d));
    let x = permute(s % columns, columns, salted(0x68bc_21eb));
    let y = permute(s / columns, rows, salted(0x02e5_be93));
    let jitter_x = random_float(s, salted(0x967a_889b));
    let jitter_y = random_float(s, salted(0x368c_c8b7));
    let [x, y, rows, columns] = [x, y, rows, columns].map(f64::from);
    [(x + (y + jitter_x) / rows) / columns, (f64::from(s) + jitter_y) / f64::from(count)]
}

/// Where `i` goes in a permutation of 0..`length` that `pattern` chooses (Kensler's listing).
fn permute(mut i: u32, length: u32, pattern: u32) -> u32 {
    let p = pattern;
    let w = length.next_power_of_two() - 1;
    loop {
        i = (i ^ p).wrapping_mul(0xe170_893d);
        i ^= p >> 16;
        i ^= (i & w) >> 4;
        i = (i ^ (p >> 8)).wrapping_mul(0x0929_eb3f);
        i ^= p >> 23;
        i = (i ^ ((i & w) >> 1)).wrapping_mul(1 | (p >> 27));
        i = i.wrapping_mul(0x6935_fa69);
        i = (i ^ ((i & w) >> 11)).wrapping_mul(0x74dc_b303);
        i = (i ^ ((i & w) >> 2)).wrapping_mul(0x9e50_1cc3);
        i = (i ^ ((i & w) >> 2)).wrapping_mul(0xc860_a3df);
        i &= w;
        i ^= i >> 5;
        if i < length {
            return ((u64::from(i) + u64::from(p)) % u64::from(length)) as u32;
        }
    }
}

/// A number from 0 to below 1 (Kensler's listing).
fn random_float(mut i: u32, pattern: u32) -> f64 {
    i ^= pattern;
    i ^= i >> 17;
    i = (i ^ (i >> 10)).wrapping_mul(0xb365_34e5);
    i ^= i >> 12;
    i = (i ^ (i >> 21)).wrapping_mul(0x93fc_4795);
    i ^= 0xdf6e_307f;
    i = (i ^ (i >> 17)).wrapping_mul(1 | (pattern >> 18));
    f64::from(i) / 4_298_115_584.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many of `count` equal strips hold one of the numbers.
    fn strips(numbers: impl Iterator<Item = f64>, count: u32) -> usize {
        let strip = |x: f64| (x * f64::from(count)) as u32;
        numbers.map(strip).collect::<std::collections::BTreeSet<_>>().len()
    }

    #[test]
    fn any_number_of_points_is_stratified() {
        for count in [1, 2, 7, 16, 48, 101] {
            for pattern in 0..20 {
                let points: Vec<_> = (0..count)
                    .map(|i| correlated_multi_jittered(i, count, mix(7, pattern)))
                    .collect();
                assert!(points.iter().flatten().all(|x| (0.0..1.0).contains(x)));
                assert_eq!(strips(points.iter().map(|p| p[1]), count), count as usize);
                let columns = f64::from(count).sqrt() as u32;
                assert_eq!(strips(points.iter().map(|p| p[0]), columns), columns as usize);
            }
        }
    }

    #[test]
    fn all_rays_of_a_pixel_share_one_pattern() {
        let points = (0..4).flat_map(|sample| {
            let sampler = Sampler::new(1, [3, 4], sample, 4).fork(9);
            (0..4).map(move |i| sampler.point(i, 4)[1])
        });
        assert_eq!(strips(points, 16), 16);
    }

    #[test]
    fn tangents_make_a_basis() {
        for n in [DVec3::X, -DVec3::Z, DVec3::Z, DVec3::new(0.6, -0.64, 0.48)] {
            let (x, y) = tangents(n);
            assert!(x.cross(y).distance(n) < 1e-12 && x.dot(n).abs() < 1e-12);
        }
    }
}
