//! The picture at the top of the README.

use super::assembly::{Assembly, Shape};
use super::menger::menger_sponge;
use super::patterns::{bands, tiles};
use super::sphere::{sphere, sphereflake};
use super::torus_knot::torus_knot;
use crate::{Camera, Cone, Light, Material, Model, Projection};
use glam::{DAffine3, DQuat, DVec3, Vec3};
use std::f64::consts::PI;

/// The scene that is rendered when none is named, with its own camera and lights: a knot of
/// polished gold, a mirror ball, a ball of glass, Menger's sponge and a sphereflake on a tiled
/// floor, under a warm soft lamp and a cool hard one. About 420,000 triangles, one metre the unit.
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
        eye: [0.35, 2.15, 8.6],
        look_at: [0.05, 0.92, 0.0],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { vfov_degrees: 28.0 },
    }
}

fn lights() -> [Light; 2] {
    let soft = Light::Rectangle {
        corner: [-5.6, 4.2, 1.0],
        edge_u: [0.0, 0.0, 3.0],
        edge_v: [1.6, 1.6, 0.0],
        radiance: [11.5, 9.0, 6.4],
    };
    let hard = Light::Point {
        position: [5.5, 6.0, 3.5],
        intensity: [44.0, 48.0, 56.0],
        cone: Some(Cone { direction: [-5.5, -5.6, -3.9], inner_angle: 0.42, outer_angle: 0.6 }),
    };
    [soft, hard]
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

fn add_floor(scene: &mut Assembly) {
    const SIDE: f64 = 60.0;
    /// Eight tiles to a texture.
    const TILE: f64 = 0.62;
    let texture = tiles(Vec3::new(0.78, 0.74, 0.68), Vec3::new(0.16, 0.2, 0.25));
    let texture = scene.texture(texture, (1.0 / (8.0 * TILE)) as f32);
    let floor = scene
        .material(Material { base_color_texture: Some(texture), ..matt("tiles", [1.0; 3], 0.55) });
    let turn = DQuat::from_rotation_y(0.6);
    let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)];
    let mut shape = Shape::default();
    shape.flat_quad(
        corners.map(|(x, z)| DVec3::new(x, 0.0, z) * SIDE),
        corners.map(|(x, z)| [x * SIDE, z * SIDE]),
    );
    scene.add(&shape, turned(0.0, 0.0, 0.0, 1.0, turn), floor);
}

fn add_knot(scene: &mut Assembly) {
    let gold = scene.material(metal("gold", [1.0, 0.72, 0.32], 0.12));
    let knot = torus_knot(2, 3, 0.2, 640, 48);
    let upright = DQuat::from_rotation_y(0.35) * DQuat::from_rotation_x(PI / 2.0 - 0.22);
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
    let blue = scene.material(metal("blue steel", [0.42, 0.62, 0.86], 0.16));
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
        assert!(count >= 200_000, "{count}");
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
