//! Scenes in which something else than +y is up.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod support;

use glam::DVec3;
use kdray::Aabb;
use kdray_render::{Background, Picture, PictureKind, RenderOptions, View, Y_UP, frame};
use kdray_scene::{Camera, Model};
use support::*;

/// Rotations by quarters, and where each takes +y.
type Turn = fn([f32; 3]) -> [f32; 3];
const TURNS: [([f64; 3], Turn); 4] = [
    ([0.0, 0.0, 1e200], |[x, y, z]| [x, -z, y]),
    ([0.0, 0.0, -1.0], |[x, y, z]| [x, z, -y]),
    ([-1e-300, 0.0, 0.0], |[x, y, z]| [-y, x, z]),
    ([0.0, -1e9, 0.0], |[x, y, z]| [-x, -y, z]),
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
fn a_frame_holds_the_scene_upright_whatever_is_up() {
    let bounds = Aabb { min: [-1.0, 2.0, -3.0], max: [4.0, 2.5, 5.0] };
    for up in [Y_UP, [1.0, 2.0, -0.5], [3.0, 0.0, 0.0], [1e-9, -1.0, 0.0], [0.0, -1.0, 2e-16]] {
        let camera = frame(&bounds, up, 1.5);
        let view = View::new(&camera, 1.5).unwrap();
        let [eye, middle, up] = [camera.eye, bounds.center().map(f64::from), up].map(DVec3::from);
        assert!((eye - middle).dot(up) > 0.0, "{up}: from above");
        let [forward, right, upward] = [[0.5, 0.5], [1.0, 0.5], [0.5, 0.0]]
            .map(|[x, y]| DVec3::from(view.ray(x, y).direction));
        let axis = |edge: DVec3| edge / edge.dot(forward) - forward;
        let (right, upward) = (axis(right), axis(upward));
        for corner in 0..8 {
            let side = |k: usize| if corner >> k & 1 == 0 { bounds.min[k] } else { bounds.max[k] };
            let way = DVec3::from([0, 1, 2].map(|k| f64::from(side(k)))) - eye;
            let at = way / way.dot(forward);
            for axis in [right, upward] {
                let place = at.dot(axis) / axis.length_squared();
                assert!(place.abs() < 1.0, "{up}: corner {corner} is at {place}");
            }
        }
    }
}

#[test]
fn the_sky_is_deepest_where_up_points() {
    let world = world(Model::default());
    let seen = |direction: DVec3, up: DVec3| {
        let camera = Camera {
            eye: [0.0; 3],
            look_at: direction.into(),
            up: [0.3, 0.2, 0.1],
            ..from_above(0.0, 0.0, 1e-9)
        };
        let options = RenderOptions { background: Background::sky(up.into()), ..plain(1, 1, 1) };
        shoot(&world, &camera, &[], &options).floats("color", "R").unwrap()[0]
    };
    let (zenith, horizon) = (0.14, 0.82);
    for up in [Y_UP, [0.0, 0.0, 7.0], [-2.0, 1.0, 2.0], [1e-203, 1e-202, 0.0]].map(DVec3::from) {
        let overhead = (up / up.abs().max_element()).normalize();
        let across = overhead.any_orthonormal_vector();
        // What share of the zenith's colour each has, by the sine of its height.
        for (sine, share) in
            [(1.0_f64, 1.0), (0.5, 0.5_f32.sqrt()), (0.09, 0.3), (0.0, 0.0), (-0.5, 0.0)]
        {
            let direction = sine * overhead + (1.0 - sine * sine).sqrt() * across;
            let expected = horizon + share * (zenith - horizon);
            let found = seen(direction, up);
            assert!((found - expected).abs() < 1e-5, "{up}, {sine}: {found}, not {expected}");
        }
    }
}
