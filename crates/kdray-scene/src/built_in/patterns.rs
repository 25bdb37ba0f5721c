//! Textures made by code.

use crate::{Texture, Wrap};
use glam::{FloatExt, Vec3};

/// A picture of `size` x `size` pixels whose colour at (u, v), from 0 to 1, is `color`.
fn painted(size: usize, wrap: Wrap, color: impl Fn(f32, f32) -> Vec3) -> Texture {
    let middle = |i: usize| (i as f32 + 0.5) / size as f32;
    let pixel = |i: usize| color(middle(i % size), middle(i / size)).extend(1.0).to_array();
    let pixels = (0..size * size).map(pixel).collect();
    Texture { width: size, height: size, pixels, wrap: [wrap; 2] }
}

/// Square tiles in two colours, 8 by 8, each a little lighter or darker than the next, with
/// joints between them.
pub(super) fn tiles(light: Vec3, dark: Vec3) -> Texture {
    const COUNT: f32 = 8.0;
    const JOINT: f32 = 0.018;
    painted(1024, Wrap::Repeat, |u, v| {
        let (column, row) = ((u * COUNT).floor(), (v * COUNT).floor());
        let color = if (column + row) as i32 % 2 == 0 { light } else { dark };
        let tone = 0.88 + 0.12 * noise(column as i32, row as i32);
        let edge = |x: f32| (x * COUNT).fract().min(1.0 - (x * COUNT).fract());
        let joint = (edge(u).min(edge(v)) / JOINT).clamp(0.0, 1.0);
        let veins = 1.0 + 0.06 * (turbulence(u * 40.0, v * 40.0) - 0.5);
        (color * tone * veins).lerp(Vec3::splat(0.09), 1.0 - joint * joint)
    })
}

/// Bands from pole to pole, drawn out by turbulence, as on a gas planet.
pub(super) fn bands(colors: &[Vec3]) -> Texture {
    painted(512, Wrap::Clamp, |u, v| {
        let stirred = v + 0.035 * (turbulence(u * 9.0, v * 22.0) - 0.5);
        let place = stirred.clamp(0.0, 0.999) * (colors.len() - 1) as f32;
        let (lower, share) = (place as usize, place.fract());
        let smooth = share * share * (3.0 - 2.0 * share);
        colors[lower].lerp(colors[lower + 1], smooth)
    })
}

/// Four octaves of smooth noise, from 0 to 1.
fn turbulence(x: f32, y: f32) -> f32 {
    let octave = |i: i32| {
        let scale = 2.0_f32.powi(i);
        smooth_noise(x * scale, y * scale) / (2.0 * scale)
    };
    (0..4).map(octave).sum::<f32>() * (16.0 / 15.0)
}

fn smooth_noise(x: f32, y: f32) -> f32 {
    let (column, row) = (x.floor() as i32, y.floor() as i32);
    let smooth = |t: f32| t * t * (3.0 - 2.0 * t);
    let (s, t) = (smooth(x - x.floor()), smooth(y - y.floor()));
    let above = noise(column, row).lerp(noise(column + 1, row), s);
    let below = noise(column, row + 1).lerp(noise(column + 1, row + 1), s);
    above.lerp(below, t)
}

/// A number from 0 to 1 for a point of the grid.
fn noise(x: i32, y: i32) -> f32 {
    let mut hash = (x as u32).wrapping_mul(0x9e37_79b1) ^ (y as u32).wrapping_mul(0x85eb_ca77);
    hash = (hash ^ (hash >> 15)).wrapping_mul(0xc2b2_ae3d);
    hash = (hash ^ (hash >> 12)).wrapping_mul(0x2754_4b2d);
    (hash >> 8) as f32 / (1 << 24) as f32
}
