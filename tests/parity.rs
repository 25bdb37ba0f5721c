//! Rays at every vertex and every edge midpoint of closed meshes cross them an even number of times
//! from outside and an odd number from inside.
//!
//! Spheres and tori are aimed at in full. Of the scenes beside the checkout one ray of [`STEP`] is
//! traced, or all with the environment variable `KDRAY_FULL` set; `cargo xtask parity --full` does
//! the same in a release build, for all scenes, with a table.

use kdray::{BuildOptions, Scene, Strategy, TriangleMesh};
use kdray_tests::closed::closed_part;
use kdray_tests::meshes::{TORUS_RADIUS, mesh, soup, sphere, torus};
use kdray_tests::parity::{OUTSIDE, Parity, from_inside, from_outside};
use kdray_tests::rays::random;
use kdray_tests::shared::{load_mesh, scenes};
use rand::RngExt;
use std::f64::consts::TAU;

/// One of this many rays at a scene is traced; coprime to the number of origins.
const STEP: usize = 1999;

/// Scenes with closed parts.
const CLOSED: [&str; 4] = ["cad_cnc_counter", "cad_engine", "robot_go2", "awkward_stadium"];

fn scene(mesh: TriangleMesh, strategy: Strategy) -> Scene {
    let options = BuildOptions { leaf_size: 1, ..BuildOptions::for_strategy(strategy) };
    Scene::build(mesh, &options).expect("the mesh is valid")
}

fn assert_even(name: &str, found: &Parity) {
    assert_eq!(found.odd, 0, "{name}: {found:?}");
    assert!(found.crossing * 4 > found.rays, "{name} was hardly crossed at all: {found:?}");
}

fn assert_odd(name: &str, found: &Parity) {
    assert_eq!(found.odd, found.rays, "{name}: {found:?}");
}

#[test]
fn spheres_count_even_from_outside() {
    for strategy in Strategy::ALL {
        assert_even("sphere", &from_outside(&scene(sphere(16), strategy), 1));
    }
}

#[test]
fn tori_count_even_from_outside() {
    for strategy in Strategy::ALL {
        assert_even("torus", &from_outside(&scene(torus(24, 16), strategy), 1));
    }
}

#[test]
fn spheres_count_odd_from_inside() {
    let mut random = random(51);
    let mut inside = || [0; 3].map(|_| random.random_range(-0.5..0.5));
    let origins: Vec<_> = (0..OUTSIDE - 1).map(|_| inside()).chain([[0.0; 3]]).collect();
    for strategy in [Strategy::Middle, Strategy::Sah] {
        assert_odd("sphere", &from_inside(&scene(sphere(16), strategy), &origins));
    }
}

#[test]
fn tori_count_odd_from_inside() {
    let inside = |i: usize| {
        let angle = TAU * (i as f64 + 0.3) / OUTSIDE as f64;
        let height = 0.2 * (i as f64 / OUTSIDE as f64 - 0.5);
        [TORUS_RADIUS * angle.cos(), TORUS_RADIUS * angle.sin(), height]
    };
    let origins: Vec<_> = (0..OUTSIDE).map(inside).collect();
    for strategy in [Strategy::Middle, Strategy::Sah] {
        assert_odd("torus", &from_inside(&scene(torus(24, 16), strategy), &origins));
    }
}

#[test]
fn odd_counts_are_noticed() {
    let found = from_outside(&scene(mesh(soup(20, [0.0; 3], 1.0, 3)), Strategy::Sah), 1);
    assert!(found.odd > 0, "a soup is not closed");
}

#[test]
fn closed_parts_of_scenes_count_even_from_outside() {
    let step = if std::env::var_os("KDRAY_FULL").is_some() { 1 } else { STEP };
    let Some(scenes) = scenes() else { return };
    for name in CLOSED {
        let info = scenes.iter().find(|info| info.name == name).expect("a scene of that name");
        let closed = closed_part(&load_mesh(info).expect("the scene loads"));
        println!("{name}: {} triangles are in closed parts", closed.triangles().len());
        assert!(!closed.triangles().is_empty(), "{name} has no closed part");
        let found = from_outside(&Scene::build(closed, &BuildOptions::default()).unwrap(), step);
        assert_eq!(found.odd, 0, "{name}: {found:?}");
        assert!(found.crossing > 0, "{name}: {found:?}");
    }
}
