//! A fractal terrain: a square of fractional Brownian motion over gradient noise (Perlin 1985;
//! Musgrave, Kolb and Mace 1989). It is the same surface at every size, only sampled finer.

use super::{FixedView, Mesh};

/// Low over a corner of the unit square, the light high over the far side.
pub(super) const VIEW: FixedView = FixedView {
    eye: [-0.12, 0.38, -0.12],
    look_at: [0.45, 0.05, 0.45],
    up: [0.0, 1.0, 0.0],
    vfov_degrees: 40.0,
    light: [0.85, 0.7, 0.2],
};

/// Octaves of noise; the last one has a wavelength of 1/6000.
const OCTAVES: u32 = 12;

/// The height of the hills, by the side of the square.
const HEIGHT: f64 = 0.3;

/// A terrain of exactly `triangles` triangles if that is an even number.
pub(super) fn terrain(triangles: u32) -> Mesh {
    let [columns, rows] = cells(triangles);
    let mut mesh = Mesh::default();
    let place = |i: u32, count: u32| f64::from(i) / f64::from(count);
    mesh.grid(rows, columns, |x, z| {
        let (x, z) = (place(x, rows), place(z, columns));
        [x, HEIGHT * height(x, z), z]
    });
    mesh
}

/// The sides of the most nearly square grid of half as many cells as there are triangles, the
/// longer one first.
pub(super) fn cells(triangles: u32) -> [u32; 2] {
    let cells = triangles / 2;
    let root = f64::from(cells).sqrt() as u32;
    let rows = (1..=root).rev().find(|rows| cells.is_multiple_of(*rows)).unwrap_or(1);
    [cells / rows, rows]
}

/// From about −0.5 to 0.5.
fn height(x: f64, z: f64) -> f64 {
    let (mut sum, mut amplitude, mut frequency) = (0.0, 0.5, 3.0);
    for octave in 0..OCTAVES {
        sum += amplitude * noise(x * frequency, z * frequency, octave);
        amplitude *= 0.5;
        frequency *= 2.0;
    }
    sum
}

/// Gradient noise: zero at whole numbers, smooth between them.
fn noise(x: f64, z: f64, octave: u32) -> f64 {
    let (column, row) = (x.floor(), z.floor());
    let (dx, dz) = (x - column, z - row);
    let corner = |i: i32, j: i32| {
        let angle = f64::from(hash(column as i32 + i, row as i32 + j, octave)) * 1.463e-9;
        (dx - f64::from(i)) * angle.cos() + (dz - f64::from(j)) * angle.sin()
    };
    let smooth = |t: f64| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
    let (u, v) = (smooth(dx), smooth(dz));
    mix(mix(corner(0, 0), corner(1, 0), u), mix(corner(0, 1), corner(1, 1), u), v)
}

/// 32 bits that look random.
fn hash(x: i32, z: i32, octave: u32) -> u32 {
    let mut h = (x as u32).wrapping_mul(0x9e37_79b1) ^ (z as u32).wrapping_mul(0x85eb_ca77);
    h ^= octave.wrapping_mul(0xc2b2_ae3d);
    for _ in 0..2 {
        h = (h ^ (h >> 16)).wrapping_mul(0x7feb_352d);
        h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
    }
    h ^ (h >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finer_terrains_go_through_the_points_of_coarser_ones() {
        let (coarse, fine) = (terrain(200), terrain(800));
        assert_eq!(coarse.vertices[0], fine.vertices[0]);
        let (last, finest) = (coarse.vertices.last(), fine.vertices.last());
        assert_eq!(last, finest);
    }

    #[test]
    fn hills_are_neither_flat_nor_steep() {
        let mesh = terrain(20_000);
        let heights = mesh.vertices.iter().map(|vertex| vertex[1]);
        let (low, high) = heights.fold((f32::MAX, f32::MIN), |(l, h), y| (l.min(y), h.max(y)));
        assert!(high - low > 0.1 && high - low < 0.4, "{low} to {high}");
    }
}
