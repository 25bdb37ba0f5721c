//! Pictures as a whole: threads, golden images, refusals.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod support;

use kdray::{BuildOptions, InstructionSet, Strategy};
use kdray_render::{
    Background, CameraError, LightError, Picture, PictureKind, PngDepth, RenderError,
    RenderOptions, WorldError, Y_UP, render_with_progress,
};
use kdray_scene::{Camera, Light, Model, Projection};
use std::path::Path;
use support::*;

#[test]
fn any_number_of_threads_gives_the_same_picture() {
    let (world, camera, lights) = still_life();
    let options = RenderOptions { all_layers: true, ..small(PictureKind::Shaded) };
    let with_threads = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| shoot(&world, &camera, &lights, &options))
    };
    let one = with_threads(1);
    assert_eq!(one.layers.len(), 7);
    for threads in [2, 3] {
        assert!(with_threads(threads) == one, "{threads} threads");
    }
    let other_seed = RenderOptions { seed: 1, ..options.clone() };
    assert!(shoot(&world, &camera, &lights, &other_seed) != one, "the seed matters");
}

#[test]
fn packets_change_no_picture() {
    let (with_glass, camera, mut lights) = still_life();
    let mut opaque = Model { materials: vec![lambert(0.8)], ..Model::default() };
    add_floor(&mut opaque, 4.0, 0.0, 0);
    add_box(&mut opaque, [-1.0, 0.5, -1.0], [0.5, 1.5, 1.0], 0);
    let all = RenderOptions { all_layers: true, ..small(PictureKind::Shaded) };
    let in_batches = RenderOptions { packets: false, ..all.clone() };
    let projection = Projection::Orthographic { height: 3.0 };
    let orthographic = Camera { projection, ..camera.clone() };
    lights.push(Light::Directional { direction: [0.3, -1.0, 0.2], irradiance: [0.5; 3] });
    for world in [with_glass, world(opaque)] {
        for camera in [&camera, &orthographic] {
            // Of packets there is a layer as well, whose rays go together in other numbers.
            let [picture, expected] = [&all, &in_batches].map(|options| {
                let mut layers = shoot(&world, camera, &lights, options).layers;
                layers.retain(|layer| layer.name != "packet");
                layers
            });
            assert_eq!(picture.len(), 6);
            assert!(picture == expected);
        }
    }
}

/// Plain Rust answers all rays one by one.
fn has_no_packets() -> bool {
    InstructionSet::available().len() == 1
}

#[test]
fn packets_are_larger_where_more_rays_meet_the_same() {
    let mut model = Model { materials: vec![lambert(0.8)], ..Model::default() };
    add_floor(&mut model, 100.0, 0.0, 0);
    let (_, camera, lights) = still_life();
    let options = small(PictureKind::PacketSize);
    let picture = shoot(&world(model), &camera, &lights, &options);
    let [sizes, costs] = ["size", "cost"].map(|name| picture.floats("packet", name).unwrap());
    let expected = if has_no_packets() { 1.0 } else { 64.0 };
    assert!(sizes.iter().all(|&size| size >= expected), "{sizes:?}");
    assert!(costs.iter().all(|&cost| cost < 1.0), "one decision is for many rays");
}

#[test]
fn opaque_things_cast_the_same_shadows_whether_or_not_glass_is_elsewhere() {
    let picture = |with_glass: bool| {
        let materials = vec![lambert(0.8), glass(1.5)];
        let mut model = Model { materials, ..Model::default() };
        add_floor(&mut model, 4.0, 0.0, 0);
        add_box(&mut model, [-1.0, 0.5, -1.0], [0.5, 1.5, 1.0], 0);
        let elsewhere = [[0.0, -3.0, 0.0], [1.0, -3.0, 0.0], [0.0, -2.5, 0.0], [0.0, -2.5, 0.1]];
        add_quad(&mut model, elsewhere, u32::from(with_glass));
        let options = RenderOptions { occlusion_distance: Some(2.0), ..small(PictureKind::Shaded) };
        let (_, camera, lights) = still_life();
        shoot(&world(model), &camera, &lights, &options)
    };
    // They are of different scenes, as their parts say.
    assert!(picture(true).layers == picture(false).layers);
}

#[test]
fn a_layer_is_the_same_alone_and_among_all() {
    let (world, camera, lights) = still_life();
    let all = RenderOptions { all_layers: true, ..small(PictureKind::Shaded) };
    let all = shoot(&world, &camera, &lights, &all);
    for kind in PictureKind::ALL {
        let alone = shoot(&world, &camera, &lights, &small(kind));
        assert_eq!(alone.layers.len(), 1);
        assert!(all.layers.contains(&alone.layers[0]), "{kind:?}");
    }
}

/// At most this share of pixels may differ from a golden image by more than `LEVELS` of 255 on
/// some channel: what other rounding of powers and sines on another machine may do.
const SHARE: f64 = 0.01;
const LEVELS: u8 = 4;

/// Compares with `tests/golden/NAME.png`; with `KDRAY_BLESS` set, writes it instead.
fn assert_golden(picture: &Picture, name: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/golden/{name}.png"));
    let written = png(picture, PngDepth::Eight);
    if std::env::var_os("KDRAY_BLESS").is_some() {
        std::fs::write(&path, &written).unwrap();
    }
    let golden = image::open(&path).unwrap().to_rgba8();
    let now = image::load_from_memory(&written).unwrap().to_rgba8();
    assert_eq!(golden.dimensions(), now.dimensions(), "{name}");
    let differs = |(a, b): (&image::Rgba<u8>, &image::Rgba<u8>)| {
        a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > LEVELS)
    };
    let differing = golden.pixels().zip(now.pixels()).filter(|&pair| differs(pair)).count();
    let share = differing as f64 / (golden.width() * golden.height()) as f64;
    assert!(share <= SHARE, "{name}: {differing} pixels differ; KDRAY_BLESS=1 makes it anew");
}

#[test]
fn the_still_life_looks_as_it_did() {
    let (world, camera, lights) = still_life();
    // Cost is that of the lecture's traversal, and looked at in its tree.
    let (lecture, ..) = still_life_in(&BuildOptions::for_strategy(Strategy::Sah));
    for kind in PictureKind::ALL {
        let of_packets = [PictureKind::PacketCost, PictureKind::PacketSize];
        if of_packets.contains(&kind) && has_no_packets() {
            continue;
        }
        let of_cost = [PictureKind::Cost, PictureKind::CostNodes, PictureKind::CostPrimitives];
        let world = if of_cost.contains(&kind) { &lecture } else { &world };
        let picture = shoot(world, &camera, &lights, &small(kind));
        assert_golden(&picture, &format!("still_life_{kind:?}").to_lowercase());
    }
}

#[test]
fn the_showcase_looks_as_it_did() {
    let world = world(kdray_scene::built_in::showcase());
    let options = RenderOptions { width: 96, height: 54, ..small(PictureKind::Shaded) };
    let model = world.model();
    let picture = shoot(&world, &model.cameras[0], &model.lights, &options);
    assert_golden(&picture, "showcase");
}

#[test]
fn a_scene_without_lights_or_camera_is_seen() {
    let mut model = Model { materials: vec![lambert(0.8)], ..Model::default() };
    add_box(&mut model, [100.0, 7.0, -3.0], [101.0, 9.0, 2.0], 0);
    let world = world(model);
    let camera = kdray_render::frame(world.bounds(), Y_UP, 2.0);
    let options = RenderOptions { width: 64, height: 32, ..plain(64, 32, 1) };
    let picture = shoot(&world, &camera, &[], &options);
    let red = picture.floats("color", "R").unwrap();
    let seen = |i: usize| red[i] > 0.02;
    let count = (0..64 * 32).filter(|&i| seen(i)).count();
    assert!(count > 250, "it fills a good part, not {count} pixels");
    assert!((0..64).all(|x| !seen(x) && !seen(31 * 64 + x)), "and is not cut off");
    assert!(red.iter().all(|&x| x < 1.0), "nor too bright");
}

#[test]
fn an_interior_without_lights_is_not_dark() {
    let mut model = Model { materials: vec![lambert(0.8)], ..Model::default() };
    add_box(&mut model, [-5.0, 0.0, -5.0], [5.0, 4.0, 5.0], 0);
    let world = world(model);
    let camera = kdray_scene::Camera {
        eye: [0.5, 2.0, 4.0],
        look_at: [0.0, 1.5, 0.0],
        ..from_above(0.0, 0.0, 3.0)
    };
    let camera = kdray_scene::Camera { up: Y_UP, ..camera };
    let picture = shoot(&world, &camera, &[], &plain(8, 8, 1));
    let green = picture.floats("color", "G").unwrap();
    let [darkest, brightest] =
        [f32::min, f32::max].map(|pick| green.iter().copied().reduce(pick).unwrap());
    assert!(darkest > 0.01 && brightest < 1.0, "from {darkest} to {brightest}");
}

#[test]
fn what_cannot_be_rendered_is_refused() {
    let (world, camera, lights) = still_life();
    let refused = |camera: &_, lights: &[Light], options: &RenderOptions| {
        let begun = |_| panic!("work was begun");
        let error = render_with_progress(&world, camera, lights, options, &begun).unwrap_err();
        let advised =
            error.to_string().contains("; ") || matches!(error, RenderError::Option { .. });
        assert!(advised, "it does not say what to do: {error}");
        error
    };
    let sized = |width, height| RenderOptions { width, height, ..small(PictureKind::Shaded) };
    let empty = RenderError::EmptyPicture { width: 0, height: 5 };
    assert_eq!(refused(&camera, &lights, &sized(0, 5)), empty);
    let vast = refused(&camera, &lights, &sized(usize::MAX, usize::MAX));
    assert!(matches!(vast, RenderError::TooLarge { .. }));
    let large = refused(&camera, &lights, &sized(1 << 20, 1 << 20));
    assert!(matches!(large, RenderError::TooLarge { .. }));

    let mut blind = camera.clone();
    blind.look_at = blind.eye;
    let options = small(PictureKind::Shaded);
    assert_eq!(refused(&blind, &lights, &options), CameraError::NoDirection.into());
    blind.look_at = [f64::NAN; 3];
    assert_eq!(refused(&blind, &lights, &options), CameraError::NotFinite.into());
    let bad = Light::Directional { direction: [0.0; 3], irradiance: [1.0; 3] };
    assert_eq!(refused(&camera, &[bad], &options), LightError::ZeroDirection(0).into());
    let none = RenderOptions { samples: 0, ..options.clone() };
    assert!(matches!(
        refused(&camera, &lights, &none),
        RenderError::Option { option: "samples", .. }
    ));
    for up in [[0.0; 3], [f64::NAN, 0.0, 1.0], [f64::INFINITY; 3]] {
        let nowhere = RenderOptions { background: Background::sky(up), ..options.clone() };
        assert!(matches!(
            refused(&camera, &lights, &nowhere),
            RenderError::Option { option: "background", .. }
        ));
        let blind = kdray_render::frame(world.bounds(), up, 1.0);
        let error = refused(&blind, &lights, &nowhere);
        assert!(matches!(error, RenderError::Camera(_)), "{error}");
    }
}

#[test]
fn models_that_contradict_themselves_are_refused() {
    let refused = |change: &dyn Fn(&mut Model)| {
        let mut model = Model { materials: vec![lambert(1.0)], ..Model::default() };
        add_floor(&mut model, 1.0, 0.0, 0);
        change(&mut model);
        let error = kdray_render::World::new(model, &kdray::BuildOptions::default()).unwrap_err();
        assert!(error.to_string().contains("; "), "it does not say what to do: {error}");
        error
    };
    let short = WorldError::Length { list: "colors", found: 1, triangles: 2 };
    assert_eq!(refused(&|m| m.colors.push([[1.0; 3]; 3])), short);
    let missing = refused(&|m| m.material_ids[1] = 7);
    assert_eq!(missing, WorldError::NoSuchMaterial { triangle: 1, material: 7, materials: 1 });
    let missing = refused(&|m| m.materials[0] = textured(lambert(1.0)));
    assert_eq!(missing, WorldError::NoSuchTexture { material: 0, texture: 0, textures: 0 });
    let mut texture = checker();
    texture.pixels.pop();
    assert!(matches!(
        refused(&|m| m.textures.push(texture.clone())),
        WorldError::TextureSize { texture: 0, pixels: 63, .. }
    ));
    assert!(matches!(refused(&|m| m.vertices[0] = [f32::NAN; 3]), WorldError::Mesh(_)));
}

#[test]
fn an_empty_scene_shows_the_background() {
    let world = world(Model::default());
    let camera = kdray_render::frame(world.bounds(), Y_UP, 1.0);
    let options = RenderOptions { all_layers: true, ..small(PictureKind::Shaded) };
    let picture = shoot(&world, &camera, &[], &options);
    assert!(picture.complete);
    assert!(picture.floats("depth", "Z").unwrap().iter().all(|z| *z == f32::INFINITY));
    assert!(picture.floats("color", "B").unwrap().iter().all(|b| *b > 0.1));
}
