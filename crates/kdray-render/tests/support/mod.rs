//! Small scenes, and how they are rendered here.
#![allow(dead_code, reason = "each test binary uses a part")]

use kdray::{Aabb, BuildOptions};
use kdray_render::{
    Background, Picture, PictureKind, PngDepth, RenderOptions, World, Y_UP, frame, render,
};
use kdray_scene::{Camera, Light, Material, Model, Projection, Texture, TextureRef, Wrap};

/// A light that gives none, so that none is added.
pub(crate) const DARK: Light =
    Light::Directional { direction: [0.0, -1.0, 0.0], irradiance: [0.0; 3] };

pub(crate) fn add_quad(model: &mut Model, corners: [[f32; 3]; 4], material: u32) {
    let first = model.vertices.len() as u32;
    model.vertices.extend(corners);
    model.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t: [u32; 3]| t.map(|i| first + i)));
    model.uvs.extend([[[0.0, 0.0], [0.0, 1.0], [1.0, 1.0]], [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0]]]);
    model.material_ids.extend([material; 2]);
    model.normals.clear();
}

/// A square of side 2·`half` at a height, its front up.
pub(crate) fn add_floor(model: &mut Model, half: f32, y: f32, material: u32) {
    let h = half;
    add_quad(model, [[-h, y, -h], [-h, y, h], [h, y, h], [h, y, -h]], material);
}

/// A box from `min` to `max`, its fronts outside.
pub(crate) fn add_box(model: &mut Model, min: [f32; 3], max: [f32; 3], material: u32) {
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for (side, at) in [(min, min[axis]), (max, max[axis])] {
            let corner = |pu: f32, pv: f32| {
                let mut p = side;
                (p[axis], p[u], p[v]) = (at, pu, pv);
                p
            };
            let around = [(min[u], min[v]), (max[u], min[v]), (max[u], max[v]), (min[u], max[v])];
            let mut corners = around.map(|(pu, pv)| corner(pu, pv));
            if at == min[axis] {
                corners.reverse();
            }
            add_quad(model, corners, material);
        }
    }
}

/// A ball of 8·16^2 triangles with smooth normals; the model must have none without.
pub(crate) fn add_ball(model: &mut Model, center: [f32; 3], radius: f32, material: u32) {
    const CUTS: u32 = 16;
    let missing = model.triangles.len() - model.normals.len();
    let flat: Vec<_> = model.triangles[model.normals.len()..]
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|i| glam::Vec3::from(model.vertices[i as usize]));
            [(b - a).cross(c - a).normalize().to_array(); 3]
        })
        .collect();
    assert_eq!(missing, flat.len());
    model.normals.extend(flat);
    let mut add = |corners: [glam::Vec3; 3]| {
        let normals = corners.map(glam::Vec3::normalize);
        let first = model.vertices.len() as u32;
        let center = glam::Vec3::from(center);
        model.vertices.extend(normals.map(|n| (center + radius * n).to_array()));
        model.triangles.push([first, first + 1, first + 2]);
        model.normals.push(normals.map(|n| n.to_array()));
        model.uvs.push([[0.0; 2]; 3]);
        model.material_ids.push(material);
    };
    for octant in 0..8 {
        let sign = |bit: i32| if octant & bit == 0 { 1.0 } else { -1.0 };
        let point = |i: u32, j: u32| {
            let (x, y) = (i as f32 / CUTS as f32, j as f32 / CUTS as f32);
            glam::Vec3::new(sign(1) * x, sign(2) * y, sign(4) * (1.0 - x - y))
        };
        let flip = sign(1) * sign(2) * sign(4) < 0.0;
        let mut turned = |[a, b, c]: [glam::Vec3; 3]| add(if flip { [a, c, b] } else { [a, b, c] });
        for i in 0..CUTS {
            for j in 0..CUTS - i {
                turned([point(i, j), point(i + 1, j), point(i, j + 1)]);
                if i + j + 1 < CUTS {
                    turned([point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)]);
                }
            }
        }
    }
}

/// A surface that reflects `albedo` diffusely and nothing else.
pub(crate) fn lambert(albedo: f32) -> Material {
    Material { base_color: [albedo; 3], specular: [0.0; 3], roughness: 1.0, ..Material::default() }
}

/// Clear glass.
pub(crate) fn glass(ior: f32) -> Material {
    Material { base_color: [1.0; 3], transmission: 1.0, ior, ..Material::default() }
}

pub(crate) fn checker() -> Texture {
    let pixel = |i: usize| {
        if (i % 8 + i / 8).is_multiple_of(2) { [0.9, 0.9, 0.9, 1.0] } else { [0.1, 0.2, 0.4, 0.2] }
    };
    Texture { width: 8, height: 8, pixels: (0..64).map(pixel).collect(), wrap: [Wrap::Repeat; 2] }
}

pub(crate) fn textured(material: Material) -> Material {
    let texture = TextureRef { texture: 0, transform: TextureRef::IDENTITY };
    Material { base_color_texture: Some(texture), ..material }
}

pub(crate) fn world(model: Model) -> World {
    World::new(model, &BuildOptions::default()).unwrap()
}

/// Parallel rays along −y, over a square of the given height around (x, z).
pub(crate) fn from_above(x: f64, z: f64, height: f64) -> Camera {
    Camera {
        name: String::new(),
        eye: [x, 50.0, z],
        look_at: [x, 0.0, z],
        up: [0.0, 0.0, -1.0],
        projection: Projection::Orthographic { height },
    }
}

/// Small, black all around, without ambient light.
pub(crate) fn plain(width: usize, height: usize, samples: u32) -> RenderOptions {
    RenderOptions {
        width,
        height,
        samples,
        background: Background::Color([0.0; 3]),
        ambient: [0.0; 3],
        ..RenderOptions::default()
    }
}

pub(crate) fn shoot(
    world: &World,
    camera: &Camera,
    lights: &[Light],
    options: &RenderOptions,
) -> Picture {
    render(world, camera, lights, options).unwrap()
}

/// A small picture of that kind.
pub(crate) fn small(picture: PictureKind) -> RenderOptions {
    RenderOptions { width: 64, height: 48, samples: 4, picture, ..RenderOptions::default() }
}

/// The bytes of a PNG.
pub(crate) fn png(picture: &Picture, depth: PngDepth) -> Vec<u8> {
    let mut bytes = Vec::new();
    picture.write_png(&mut bytes, depth).unwrap();
    bytes
}

/// The light in the one pixel above (x, z).
pub(crate) fn light_above(
    world: &World,
    [x, z]: [f64; 2],
    lights: &[Light],
    options: &RenderOptions,
) -> f64 {
    let options = RenderOptions { width: 1, height: 1, ..options.clone() };
    let picture = shoot(world, &from_above(x, z, 1e-6), lights, &options);
    f64::from(picture.floats("color", "R").unwrap()[0])
}

/// A bit of everything: texture, mirror, glass, gloss, cut-out, soft and hard shadows.
pub(crate) fn still_life() -> (World, Camera, Vec<Light>) {
    still_life_in(&BuildOptions::default())
}

/// The same in a tree by other options.
pub(crate) fn still_life_in(options: &BuildOptions) -> (World, Camera, Vec<Light>) {
    let mut model = Model { textures: vec![checker()], ..Model::default() };
    model.materials = vec![
        textured(Material { base_color: [1.0; 3], ..Material::default() }),
        Material { mirror: [0.9; 3], ..lambert(0.02) },
        Material { attenuation_color: [0.3, 0.9, 0.6], attenuation_distance: 1.0, ..glass(1.5) },
        Material {
            metallic: 1.0,
            roughness: 0.3,
            base_color: [0.9, 0.6, 0.3],
            ..Material::default()
        },
        textured(Material {
            alpha_mode: kdray_scene::AlphaMode::Mask(0.5),
            base_color: [0.9, 0.3, 0.3],
            ..Material::default()
        }),
    ];
    add_floor(&mut model, 4.0, 0.0, 0);
    add_quad(
        &mut model,
        [[-2.5, 2.0, -1.5], [-2.5, 0.0, -1.5], [-0.5, 0.0, -2.0], [-0.5, 2.0, -2.0]],
        4,
    );
    add_ball(&mut model, [1.2, 1.0, -1.0], 1.0, 1);
    add_ball(&mut model, [-0.9, 0.7, 0.6], 0.7, 2);
    add_ball(&mut model, [0.9, 0.5, 1.3], 0.5, 3);
    let lights = vec![
        Light::Point { position: [3.0, 5.0, 4.0], intensity: [45.0; 3], cone: None },
        Light::Rectangle {
            corner: [-3.0, 4.0, 0.0],
            edge_u: [0.0, 0.0, 2.0],
            edge_v: [2.0, 1.0, 0.0],
            radiance: [5.0, 4.0, 3.0],
        },
    ];
    let bounds = Aabb { min: [-2.4, 0.0, -1.4], max: [2.4, 2.0, 1.9] };
    (World::new(model, options).unwrap(), frame(&bounds, Y_UP, 4.0 / 3.0), lights)
}
