//! The picture at the top of the README.

use super::assembly::{Assembly, Shape};
use super::menger::menger_sponge;
use super::patterns::{bands, tiles};
use super::sphere::{sphere, sphereflake};
use super::torus_knot::torus_knot;
use crate::{Camera, Light, Material, Model, Projection};
use glam::{DAffine3, DQuat, DVec3, Vec3};
use std::f64::consts::FRAC_PI_2;

/// The scene that is rendered when none is named, with its own camera and lights: a knot of
/// polished gold, a mirror ball, a ball of glass, Menger's sponge and a sphereflake on a tiled
/// terrace, under the sun and a warm soft lamp. 402,700 triangles, one metre the unit.
pub fn showcase() -> Model {
    let mut scene = Assembly::default();
    add_floor(&mut scene);
    add_knot(&mut scene);
    add_balls(&mut scene);
    add_sponge(&mut scene);
    add_flake(&mut scene);
    add_marbles(&mut scene);
    let mut model = scene.model;
    model.cameras.push(camera());
    model.lights.extend(lights());
    model
}

fn camera() -> Camera {
    Camera {
        name: "showcase".into(),
        eye: [0.5, 2.3, 8.6],
        look_at: [0.04, 0.98, 0.0],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { vfov_degrees: 25.5 },
    }
}

fn lights() -> [Light; 2] {
    let soft = Light::Rectangle {
        corner: [-5.6, 3.6, 1.2],
        edge_u: [0.0, 0.0, 3.0],
        edge_v: [1.6, 1.6, 0.0],
        radiance: [9.5, 7.2, 5.0],
    };
    let sun = Light::Directional { direction: [-0.8, -0.8, -0.42], irradiance: [2.5, 2.3, 2.0] };
    [soft, sun]
}

fn at(x: f64, y: f64, z: f64, scale: f64) -> DAffine3 {
    DAffine3::from_scale_rotation_translation(
        DVec3::splat(scale),
        DQuat::IDENTITY,
        DVec3::new(x, y, z),
    )
}

fn turned(x: f64, y: f64, z: f64, scale: f64, rotation: DQuat) -> DAffine3 {
    DAffine3::from_scale_rotation_translation(DVec3::splat(scale), rotation, DVec3::new(x, y, z))
}

fn matt(name: &str, base_color: [f32; 3], roughness: f32) -> Material {
    Material { name: name.into(), base_color, roughness, ..Material::default() }
}

fn metal(name: &str, base_color: [f32; 3], roughness: f32) -> Material {
    Material { metallic: 1.0, ..matt(name, base_color, roughness) }
}

/// Glass that has `color` after `distance`.
fn glass(name: &str, color: [f32; 3], distance: f32) -> Material {
    Material {
        transmission: 1.0,
        attenuation_color: color,
        attenuation_distance: distance,
        ..matt(name, [1.0; 3], 0.0)
    }
}

fn mirror(name: &str, color: [f32; 3]) -> Material {
    Material { mirror: color, ..matt(name, [0.02; 3], 0.1) }
}

/// A square terrace of tiles in a plain that reaches to the horizon.
fn add_floor(scene: &mut Assembly) {
    const TILE: f64 = 0.62;
    const TERRACE: f64 = 7.0 * TILE;
    const STEP: f64 = 0.12;
    const HORIZON: f64 = 120.0;
    let texture = tiles(Vec3::new(0.8, 0.76, 0.7), Vec3::new(0.13, 0.17, 0.23));
    // Eight tiles to a texture.
    let texture = scene.texture(texture, (1.0 / (8.0 * TILE)) as f32);
    let floor = scene
        .material(Material { base_color_texture: Some(texture), ..matt("tiles", [1.0; 3], 0.5) });
    let step = scene.material(matt("step", [0.55, 0.53, 0.5], 0.7));
    let plain = scene.material(matt("plain", [0.52, 0.45, 0.38], 0.9));
    let turn = turned(0.0, 0.0, 0.0, 1.0, DQuat::from_rotation_y(0.6));
    scene.add(&square(TERRACE, 0.0), turn, floor);
    scene.add(&walls(TERRACE, -STEP), turn, step);
    // Not turned, so that the horizon is level.
    scene.add(&square(HORIZON, -STEP), DAffine3::IDENTITY, plain);
}

const AROUND: [(f64, f64); 4] = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)];

/// A level square from −`half` to `half` at a height, seen from above.
fn square(half: f64, height: f64) -> Shape {
    let mut shape = Shape::default();
    shape.flat_quad(
        AROUND.map(|(x, z)| DVec3::new(x * half, height, z * half)),
        AROUND.map(|(x, z)| [x * half, z * half]),
    );
    shape
}

/// The walls below the same square, from `bottom` to zero.
fn walls(half: f64, bottom: f64) -> Shape {
    let mut shape = Shape::default();
    for side in 0..4 {
        let [(x0, z0), (x1, z1)] = [AROUND[side], AROUND[(side + 1) % 4]];
        let corner = |x: f64, y: f64, z: f64| DVec3::new(x * half, y, z * half);
        let corners = [
            corner(x0, bottom, z0),
            corner(x1, bottom, z1),
            corner(x1, 0.0, z1),
            corner(x0, 0.0, z0),
        ];
        shape.flat_quad(corners, [[0.0; 2]; 4]);
    }
    shape
}

fn add_knot(scene: &mut Assembly) {
    let gold = scene.material(metal("gold", [1.0, 0.72, 0.32], 0.07));
    let knot = torus_knot(2, 3, 0.2, 640, 48);
    let upright = DQuat::from_rotation_y(0.35) * DQuat::from_rotation_x(FRAC_PI_2 - 0.22);
    scene.add(&knot, turned(-0.1, 1.36, -0.6, 0.84, upright), gold);
}

fn add_balls(scene: &mut Assembly) {
    let chrome = scene.material(mirror("mirror", [0.93, 0.94, 0.95]));
    let clear = scene.material(glass("glass", [0.75, 0.93, 0.9], 2.0));
    let colors = [
        [0.55, 0.24, 0.14],
        [0.86, 0.62, 0.38],
        [0.93, 0.84, 0.7],
        [0.62, 0.3, 0.2],
        [0.95, 0.8, 0.58],
        [0.8, 0.45, 0.26],
        [0.92, 0.86, 0.78],
        [0.5, 0.24, 0.2],
    ];
    let texture = scene.texture(bands(&colors.map(Vec3::from)), 1.0);
    let planet = scene
        .material(Material { base_color_texture: Some(texture), ..matt("planet", [1.0; 3], 0.4) });
    let fine = sphere(6);
    scene.add(&fine, at(1.95, 0.95, -0.7, 0.95), chrome);
    scene.add(&fine, at(-1.05, 0.62, 1.35, 0.62), clear);
    scene.add(&fine, turned(0.62, 0.4, 1.15, 0.4, DQuat::from_rotation_z(0.35)), planet);
}

fn add_sponge(scene: &mut Assembly) {
    let ivory = scene.material(matt("ivory", [0.86, 0.36, 0.24], 0.5));
    let turn = DQuat::from_rotation_y(0.62);
    scene.add(&menger_sponge(3), turned(-2.55, 0.85, -0.9, 0.85, turn), ivory);
}

fn add_flake(scene: &mut Assembly) {
    let blue = scene.material(metal("blue steel", [0.42, 0.62, 0.86], 0.1));
    let ball = sphere(4);
    let place = at(1.82, 0.36, 1.25, 0.36);
    for seat in sphereflake(2) {
        scene.add(&ball, place * seat, blue);
    }
}

/// Small balls strewn in front, by turns of glass, metal and clay.
fn add_marbles(scene: &mut Assembly) {
    let materials = [
        glass("ruby", [0.9, 0.08, 0.1], 0.2),
        matt("clay", [0.2, 0.5, 0.48], 0.3),
        glass("amber", [1.0, 0.55, 0.08], 0.2),
        metal("steel", [0.9, 0.9, 0.92], 0.05),
        glass("emerald", [0.1, 0.8, 0.3], 0.2),
    ]
    .map(|material| scene.material(material));
    let places = [
        (-0.25, 2.25, 0.15),
        (0.18, 2.0, 0.11),
        (0.95, 2.1, 0.14),
        (-1.85, 1.75, 0.15),
        (-2.2, 1.2, 0.2),
        (1.3, 1.9, 0.1),
        (-0.2, 1.35, 0.12),
        (2.65, 1.55, 0.16),
        (-1.55, 2.35, 0.11),
        (0.55, 2.5, 0.1),
    ];
    let ball = sphere(4);
    for (i, (x, z, radius)) in places.into_iter().enumerate() {
        scene.add(&ball, at(x, radius, z, radius), materials[i % materials.len()]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_showcase_is_large_and_consistent() {
        let model = showcase();
        let count = model.triangles.len();
        assert_eq!(count, 402_700, "as its documentation says");
        assert_eq!([model.normals.len(), model.uvs.len(), model.material_ids.len()], [count; 3]);
        let vertices = model.vertices.len() as u32;
        assert!(model.triangles.iter().flatten().all(|&vertex| vertex < vertices));
        assert!(model.material_ids.iter().all(|&id| (id as usize) < model.materials.len()));
        let unit = |n: &[f32; 3]| (Vec3::from(*n).length() - 1.0).abs() < 1e-5;
        assert!(model.normals.iter().flatten().all(unit));
        assert_eq!(model, showcase(), "the same every time");
        assert!(model.cameras.len() == 1 && model.lights.len() == 2);
    }
}
