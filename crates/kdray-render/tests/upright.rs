//! Scenes in which something else than +y is up.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod support;

use kdray_render::{Background, Picture, PictureKind, RenderOptions, Y_UP, frame};
use kdray_scene::{Camera, Model};
use support::*;

/// Every way in which a rotation by quarters can take +y, and the rotation.
type Turn = fn([f32; 3]) -> [f32; 3];
const TURNS: [([f64; 3], Turn); 3] = [
    ([0.0, 0.0, 2.5], |[x, y, z]| [x, -z, y]),
    ([-1e-9, 0.0, 0.0], |[x, y, z]| [-y, x, z]),
    ([0.0, -1e9, 0.0], |[x, y, z]| [x, -y, -z]),
];

/// Two boxes on a floor, turned; seen by a camera that frames them, under the sky.
fn framed(turn: Turn, up: [f64; 3]) -> (Camera, Picture) {
    let mut model = Model { materials: vec![lambert(0.6)], ..Model::default() };
    add_floor(&mut model, 3.0, 0.0, 0);
    add_box(&mut model, [-2.0, 0.1, -1.5], [-0.5, 2.0, 0.5], 0);
    add_box(&mut model, [0.5, 0.1, -0.5], [1.75, 1.0, 2.0], 0);
    model.vertices.iter_mut().for_each(|vertex| *vertex = turn(*vertex));
    let world = world(model);
    let camera = frame(world.bounds(), up, 1.5);
    let background = Background::sky(up);
    let options = RenderOptions { ambient_rays: 0, background, ..small(PictureKind::Shaded) };
    let picture = shoot(&world, &camera, &[], &options);
    (camera, picture)
}

#[test]
fn a_turned_scene_under_a_turned_sky_gives_the_same_picture() {
    let (camera, picture) = framed(|point| point, Y_UP);
    let colors = |picture: &Picture| {
        ["R", "G", "B"].map(|it| picture.floats("color", it).unwrap().to_vec()).concat()
    };
    let upright = colors(&picture);
    for (up, turn) in TURNS {
        let (turned, picture) = framed(turn, up);
        let eye = turn(camera.eye.map(|x| x as f32));
        let off = |k: usize| (f64::from(eye[k]) - turned.eye[k]).abs();
        assert!((0..3).all(|k| off(k) < 1e-5), "{up:?}: {turned:?} instead of {eye:?}");
        let found = colors(&picture);
        let differing = (0..found.len()).filter(|&i| (found[i] - upright[i]).abs() > 1e-3).count();
        assert!(differing * 100 < found.len(), "{up:?}: {differing} of {} differ", found.len());
    }
}

#[test]
fn the_sky_is_deepest_where_up_points() {
    let world = world(Model::default());
    let seen = |direction: [f64; 3], up: [f64; 3]| {
        let camera = Camera {
            eye: [0.0; 3],
            look_at: direction,
            up: [0.3, 0.2, 0.1],
            ..from_above(0.0, 0.0, 1e-9)
        };
        let options = RenderOptions { background: Background::sky(up), ..plain(1, 1, 1) };
        shoot(&world, &camera, &[], &options).floats("color", "R").unwrap()[0]
    };
    let (zenith, horizon) = (0.14, 0.82);
    for up in [Y_UP, [0.0, 0.0, 7.0], [-2.0, 1.0, 2.0]] {
        assert_eq!(seen(up.map(|x| -x), up), horizon);
        let across = [up[1], -up[0], 0.0];
        let across = if across == [0.0; 3] { [1.0, 0.0, 0.0] } else { across };
        assert!((seen(up, up) - zenith).abs() < 1e-6);
        assert!((seen(across, up) - horizon).abs() < 1e-6);
    }
}
