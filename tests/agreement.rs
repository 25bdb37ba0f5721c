//! Closest hits on real scenes, through trees of every strategy, are those that testing every
//! triangle finds. A few scenes and rays; `cargo xtask agree` does all of them.

use kdray::primitives::{HitRule, intersect_triangle};
use kdray::{BuildOptions, Hit, Ray, Scene, Strategy, TriangleMesh};
use kdray_tests::agree::{agrees_with_the_oracle, compare, flat_answers, random_rays, view};
use kdray_tests::flat::Flat;
use kdray_tests::shared::{SceneInfo, load_mesh, scenes};
use kdray_tests::{meshes, rays::Archer};

/// Small scenes that are hard in different ways.
const SCENES: [&str; 7] = [
    "suzanne",
    "cornell_box",
    "teapot",
    "awkward_axis_aligned",
    "awkward_degenerate",
    "awkward_stadium",
    "awkward_utm_offset",
];

/// The scenes of [`SCENES`], all of them if there are any.
fn small_scenes() -> Vec<(SceneInfo, TriangleMesh)> {
    let Some(mut small) = scenes() else { return Vec::new() };
    small.retain(|info| SCENES.contains(&info.name.as_str()));
    assert_eq!(small.len(), SCENES.len(), "scenes have other names");
    let loaded = |info| {
        let mesh = load_mesh(&info).unwrap_or_else(|error| panic!("{error}"));
        (info, mesh)
    };
    small.into_iter().map(loaded).collect()
}

#[test]
fn every_strategy_sees_the_same_in_small_scenes() {
    for (info, mesh) in small_scenes() {
        let mut rays = info.camera.map_or_else(Vec::new, |camera| view(&camera, 48));
        rays.extend(random_rays(&mesh, 1000, 2));
        let answers = flat_answers(&mesh, &rays);
        assert!(answers.iter().flatten().count() > 100, "{} is hardly hit", info.name);
        for strategy in Strategy::ALL {
            let found = compare(&mesh, strategy, &rays, &answers);
            assert!(found.none(), "{} with {strategy}: {found:?}", info.name);
        }
    }
}

/// All queries, against arithmetic that shares no formula with kdray.
#[test]
fn small_scenes_agree_with_the_oracle() {
    for (info, mesh) in small_scenes() {
        let mut rays = Archer::new(&mesh, 3).all_kinds(4, 1e3);
        rays.extend(info.camera.map_or_else(Vec::new, |camera| view(&camera, 8)));
        let scene = Scene::build(mesh, &BuildOptions::default()).expect("the scene is valid");
        assert_eq!(agrees_with_the_oracle(&scene, &rays), Ok(()), "{}", info.name);
    }
}

/// What [`Flat`] passes over is no hit.
#[test]
fn the_flat_answer_is_that_of_testing_every_triangle() {
    let cases = [
        meshes::mesh(meshes::soup(300, [0.0; 3], 1.0, 61)),
        meshes::mesh(meshes::soup(300, [6e5, -5e6, 300.0], 40.0, 62)),
        meshes::mesh(meshes::grid(8, 3)),
        meshes::mesh(meshes::needles(200, 63)),
        meshes::torus(16, 8),
        TriangleMesh::default(),
    ];
    for mesh in &cases {
        let flat = Flat::new(mesh);
        for ray in Archer::new(mesh, 64).all_kinds(100, 1e6) {
            assert_eq!(flat.closest_hit(&ray), every_triangle(mesh, &ray), "{ray:?}");
        }
    }
}

fn every_triangle(mesh: &TriangleMesh, ray: &Ray<3>) -> Option<Hit> {
    let mut hits = Vec::new();
    for id in 0..mesh.triangles().len() as u32 {
        let corners = TriangleMesh::corners(mesh, id);
        hits.extend(intersect_triangle(&corners, id, ray, HitRule::Touching));
    }
    hits.into_iter().min_by(Hit::order)
}
