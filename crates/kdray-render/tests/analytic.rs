//! Pictures whose pixels can be computed by hand.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod support;

use kdray_render::{Background, RenderOptions, Y_UP};
use kdray_scene::{AlphaMode, Light, Material, Model};
use std::f64::consts::PI;
use support::*;

fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "found {found}, expected {expected}");
}

fn floor(material: Material) -> Model {
    let mut model = Model { materials: vec![material], ..Model::default() };
    add_floor(&mut model, 20.0, 0.0, 0);
    model
}

#[test]
fn a_point_light_falls_off_as_the_cosine_and_the_square() {
    let world = world(floor(lambert(0.6)));
    let lamp = Light::Point { position: [0.0, 3.0, 0.0], intensity: [7.0; 3], cone: None };
    for x in [0.0, 1.0, 4.0, 12.0] {
        let r2: f64 = 9.0 + x * x;
        let expected = 0.6 / PI * 7.0 * (3.0 / r2.sqrt()) / r2;
        let found = light_above(&world, [x, 0.0], std::slice::from_ref(&lamp), &plain(1, 1, 1));
        assert_near(found, expected, 1e-6 * expected);
    }
}

#[test]
fn the_sun_falls_off_as_the_cosine() {
    let world = world(floor(lambert(0.5)));
    let sun = Light::Directional { direction: [3.0, -4.0, 0.0], irradiance: [2.0; 3] };
    assert_near(
        light_above(&world, [1.0, 2.0], &[sun], &plain(1, 1, 1)),
        0.5 / PI * 2.0 * 0.8,
        1e-6,
    );
}

#[test]
fn a_rectangle_lights_as_its_form_factor_says() {
    let world = world(floor(lambert(1.0)));
    let (half, height) = (1.0_f64, 1.5);
    let lamp = Light::Rectangle {
        corner: [-half, height, -half],
        edge_u: [2.0 * half, 0.0, 0.0],
        edge_v: [0.0, 0.0, 2.0 * half],
        radiance: [3.0; 3],
    };
    // Four times the corner of a parallel rectangle (Howell, factor B-4), seen from below.
    let x = half / height;
    let root = (1.0 + x * x).sqrt();
    let factor = 4.0 / (2.0 * PI) * (2.0 * x / root * (x / root).atan());
    let options = RenderOptions { light_samples: 16, ..plain(1, 1, 64) };
    // The camera looks from above through the lamp's dark side.
    assert_near(light_above(&world, [0.0, 0.0], &[lamp], &options), 3.0 * factor, 3e-3);
}

#[test]
fn in_a_furnace_a_surface_shows_its_albedo() {
    let world = world(floor(lambert(0.3)));
    for ambient_rays in [0, 4] {
        let options = RenderOptions { ambient: [2.0; 3], ambient_rays, ..plain(1, 1, 4) };
        assert_near(light_above(&world, [0.0, 0.0], &[DARK], &options), 0.6, 1e-6);
    }
}

#[test]
fn in_a_furnace_glass_cannot_be_seen() {
    let mut model = Model { materials: vec![glass(1.5)], ..Model::default() };
    add_ball(&mut model, [0.0; 3], 1.0, 0);
    let world = world(model);
    let one = [1.0; 3];
    let options = RenderOptions {
        background: Background::Color(one),
        ambient: one,
        max_bounces: 20,
        ..plain(1, 1, 4)
    };
    for x in [0.0, 0.5, 0.9, 0.99] {
        assert_near(light_above(&world, [x, 0.0], &[DARK], &options), 1.0, 0.01);
    }
}

/// Black below and at the sides, white straight above.
const WHITE_ABOVE: Background =
    Background::Gradient { horizon: [0.0; 3], zenith: [1.0; 3], up: Y_UP };

#[test]
fn a_pane_reflects_as_fresnel_says() {
    let mut model = Model { materials: vec![glass(1.5)], ..Model::default() };
    add_box(&mut model, [-5.0, -1.0, -5.0], [5.0, 0.0, 5.0], 0);
    let options = RenderOptions { background: WHITE_ABOVE, max_bounces: 20, ..plain(1, 1, 1) };
    // Both faces reflect R = 4 %, to and fro: 2R / (1 + R).
    assert_near(light_above(&world(model), [0.1, 0.2], &[DARK], &options), 0.08 / 1.04, 1e-3);
}

#[test]
fn light_fades_in_a_body_as_beer_says() {
    let body = Material { attenuation_color: [0.5; 3], attenuation_distance: 0.75, ..glass(1.0) };
    let mut model = Model { materials: vec![body, lambert(1.0)], ..Model::default() };
    add_box(&mut model, [-5.0, 1.0, -5.0], [5.0, 2.5, 5.0], 0);
    add_floor(&mut model, 20.0, 0.0, 1);
    let sun = Light::Directional { direction: [0.0, -1.0, 0.0], irradiance: [PI as f32; 3] };
    // Twice through 1.5 = 2 · 0.75: the light on its way down, and what the floor sends up.
    let found = light_above(&world(model), [0.1, 0.2], &[sun], &plain(1, 1, 1));
    assert_near(found, 0.25 * 0.25, 1e-4);
}

#[test]
fn a_mirror_shows_what_is_above_it() {
    let world = world(floor(Material { mirror: [0.7; 3], ..lambert(0.0) }));
    let options = RenderOptions { background: WHITE_ABOVE, ..plain(1, 1, 1) };
    assert_near(light_above(&world, [0.0, 0.0], &[DARK], &options), 0.7, 1e-6);
    let none = RenderOptions { max_bounces: 0, ..options };
    assert_near(light_above(&world, [0.0, 0.0], &[DARK], &none), 0.0, 0.0);
}

#[test]
fn veils_let_their_share_through_also_of_shadow_rays() {
    let sun = Light::Directional { direction: [0.0, -1.0, 0.0], irradiance: [PI as f32; 3] };
    for (alpha_mode, through) in [
        (AlphaMode::Opaque, 0.0),
        (AlphaMode::Blend, 0.6),
        (AlphaMode::Mask(0.3), 0.0),
        (AlphaMode::Mask(0.5), 1.0),
    ] {
        let veil = Material { opacity: 0.4, alpha_mode, ..lambert(0.0) };
        let mut model = Model { materials: vec![veil, lambert(1.0)], ..Model::default() };
        add_floor(&mut model, 5.0, 1.0, 0);
        add_floor(&mut model, 5.0, 0.0, 1);
        let found =
            light_above(&world(model), [0.3, 0.1], std::slice::from_ref(&sun), &plain(1, 1, 1));
        assert_near(found, through * through, 1e-6);
    }
}

#[test]
fn what_lies_exactly_under_a_cut_out_or_a_veil_is_seen() {
    let sun = Light::Directional { direction: [0.0, -1.0, 0.0], irradiance: [PI as f32; 3] };
    for (alpha_mode, seen, id) in [(AlphaMode::Mask(0.5), 1.0, 2), (AlphaMode::Blend, 0.6, 0)] {
        let cover = Material { opacity: 0.4, alpha_mode, ..lambert(0.0) };
        let mut model = Model { materials: vec![cover, lambert(1.0)], ..Model::default() };
        add_floor(&mut model, 5.0, 0.0, 0);
        add_floor(&mut model, 5.0, 0.0, 1);
        let world = world(model);
        // Within a triangle, and on the edge that two of them share.
        for at in [[0.3, 0.1], [0.0, 0.0]] {
            let suns = std::slice::from_ref(&sun);
            assert_near(light_above(&world, at, suns, &plain(1, 1, 1)), seen, 1e-6);
        }
        let options = RenderOptions { all_layers: true, ..plain(1, 1, 1) };
        let picture = shoot(&world, &from_above(0.1, 0.3, 1e-6), &[DARK], &options);
        let ids = picture.ids("primitive", "id").unwrap();
        assert_eq!(ids[0] & !1, id, "the floor of triangles {id} and {}", id + 1);
        assert_eq!(picture.floats("depth", "Z").unwrap(), [50.0]);
        assert!(picture.floats("cost", "primitives").unwrap()[0] > 0.0);
    }
}

#[test]
fn shadows_are_hard_from_points_and_soft_from_rectangles() {
    let mut model = floor(lambert(1.0));
    add_box(&mut model, [0.0, 1.0, -4.0], [4.0, 1.1, 4.0], 0);
    let world = world(model);
    let lamp = Light::Point { position: [0.0, 3.0, 0.0], intensity: [9.0; 3], cone: None };
    let hard = |x| light_above(&world, [x, 0.0], std::slice::from_ref(&lamp), &plain(1, 1, 1));
    assert!(hard(-0.01) > 0.3 && hard(-3.0) > 0.05);

    let panel = Light::Rectangle {
        corner: [-1.0, 3.0, -0.01],
        edge_u: [2.0, 0.0, 0.0],
        edge_v: [0.0, 0.0, 0.02],
        radiance: [50.0; 3],
    };
    let soft = |x| light_above(&world, [x, 0.0], std::slice::from_ref(&panel), &plain(1, 1, 64));
    // Half of the lamp is behind the edge at x = 0, all of it less and less to the left.
    let lit: Vec<f64> = [-0.05, -0.15, -0.25, -0.35, -0.45].map(soft).to_vec();
    assert!(lit.windows(2).all(|pair| pair[0] < pair[1]), "{lit:?}");
}

#[test]
fn a_lamp_in_the_plane_of_a_ceiling_shines() {
    let mut model = floor(lambert(1.0));
    add_floor(&mut model, 20.0, 3.0, 0);
    let world = world(model);
    let lamp = Light::Point { position: [0.5, 3.0, 0.25], intensity: [9.0; 3], cone: None };
    let camera = kdray_scene::Camera {
        eye: [0.5, 2.0, 0.25],
        look_at: [0.5, 0.0, 0.25],
        ..from_above(0.5, 0.25, 1e-6)
    };
    let picture = shoot(&world, &camera, &[lamp], &plain(1, 1, 1));
    assert_near(f64::from(picture.floats("color", "G").unwrap()[0]), 1.0 / PI, 1e-6);
}

#[test]
fn unlit_surfaces_show_their_color() {
    let material = Material { unlit: true, ..lambert(0.35) };
    assert_near(
        light_above(&world(floor(material)), [0.0, 0.0], &[DARK], &plain(1, 1, 1)),
        0.35,
        1e-6,
    );
}
