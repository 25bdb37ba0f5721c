//! Scenes that are saved, loaded and mapped answer with the same bits as those that were built.

use kdray::geometry::RayPacket;
use kdray::primitives::HitArrays;
use kdray::{BuildOptions, Hit, Precision, Preset, Ray, Scene, Strategy, TriangleMesh};
use kdray_tests::{meshes, rays::Archer, shared};
use std::fs;
use tempfile::TempDir;

/// The bits of a hit.
type Bits = (u64, u32, u64, u64, bool);

fn bits(hit: Hit) -> Bits {
    let is_front = hit.side == kdray::Side::Front;
    (hit.t.to_bits(), hit.primitive_id, hit.u.to_bits(), hit.v.to_bits(), is_front)
}

/// All that a scene answers to rays.
#[derive(Debug, PartialEq)]
struct Answers {
    closest: Vec<Option<Bits>>,
    hints: Vec<Option<u32>>,
    batch: Vec<Option<Bits>>,
    any: Vec<bool>,
    any_batch: Vec<bool>,
    any_near: Vec<bool>,
    all: Vec<Vec<Bits>>,
    touched: Vec<Vec<Bits>>,
    packets: Vec<Option<Bits>>,
    any_packets: Vec<bool>,
}

impl Answers {
    fn of<T: Precision>(scene: &Scene<T>, rays: &[Ray]) -> Self {
        let found: Vec<_> = rays.iter().map(|ray| scene.closest_hit_with_hint(ray)).collect();
        let hints: Vec<_> = found.iter().map(|it| it.map(|(_, hint)| hint)).collect();
        let near: Vec<_> = hints.iter().map(|hint| hint.unwrap_or_default()).collect();
        let mut batch = vec![None; rays.len()];
        let [mut any_batch, mut any_near] = [(); 2].map(|()| vec![false; rays.len()]);
        scene.closest_hits(rays, &mut batch);
        scene.any_hits(rays, &mut any_batch);
        scene.any_hits_near(rays, &near, &mut any_near);
        let (packets, any_packets) = in_packets(scene, rays);
        Self {
            closest: rays.iter().map(|ray| scene.closest_hit(ray).map(bits)).collect(),
            hints: hints.into_iter().map(|hint| hint.map(kdray::Hint::to_bits)).collect(),
            batch: batch.into_iter().map(|hit| hit.map(bits)).collect(),
            any: rays.iter().map(|ray| scene.any_hit(ray)).collect(),
            any_batch,
            any_near,
            all: rays.iter().map(|ray| scene.all_hits(ray).map(bits).collect()).collect(),
            touched: rays.iter().map(|ray| scene.all_touched(ray).map(bits).collect()).collect(),
            packets,
            any_packets,
        }
    }
}

/// The same directions from one origin, beside the scene.
fn in_packets<T: Precision>(scene: &Scene<T>, rays: &[Ray]) -> (Vec<Option<Bits>>, Vec<bool>) {
    let (bounds, space) = (scene.tree().bounds(), scene.mesh().tree_space());
    let in_mesh = |p: [f64; 3]| [0, 1, 2].map(|k| p[k] / space.scale() + space.center()[k]);
    let origin = in_mesh(bounds.max.map(|x| f64::from(x) + 1.0));
    let center = in_mesh(bounds.center());
    let row = |axis: usize| -> Vec<f64> {
        let towards = center[axis] - origin[axis];
        rays.iter().map(|ray| towards + 0.2 * towards.abs() * ray.direction[axis]).collect()
    };
    let (x, y, z) = (row(0), row(1), row(2));
    let packet = RayPacket::from(origin, [&x, &y, &z]);
    let (mut hits, mut found) = (HitArrays::default(), vec![false; rays.len()]);
    scene.packet_closest_hits(&packet, &mut hits);
    scene.packet_any_hits(&packet, &mut found);
    ((0..rays.len()).map(|i| hits.get(i).map(bits)).collect(), found)
}

/// Saves a scene, and compares the answers of what comes back with its own.
fn check<T: Precision>(name: &str, mesh: TriangleMesh<T>, options: &BuildOptions, rays: &[Ray]) {
    let built = Scene::build(mesh, options).unwrap_or_else(|error| panic!("{name}: {error}"));
    let folder = TempDir::new().expect("a temporary folder");
    let (path, again) = (folder.path().join("tree"), folder.path().join("again"));
    kdray_file::save(&built, &path).unwrap_or_else(|error| panic!("{name}: {error}"));
    let loaded: Scene<T> =
        kdray_file::load(&path, None).unwrap_or_else(|error| panic!("{name}: {error}"));
    let mapped: Scene<T> = kdray_file::map(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
    assert_eq!(mapped.verify(), Ok(()), "{name}");
    kdray_file::save(&mapped, &again).unwrap_or_else(|error| panic!("{name}: {error}"));
    let bytes = [&path, &again].map(|path| fs::read(path).expect("it was written"));
    assert!(bytes[0] == bytes[1], "{name}: saved once more it differs");
    let expected = Answers::of(&built, rays);
    assert!(Answers::of(&loaded, rays) == expected, "{name}: loaded it answers otherwise");
    assert!(Answers::of(&mapped, rays) == expected, "{name}: mapped it answers otherwise");
    let hits = expected.closest.iter().flatten().count() + expected.all.iter().flatten().count();
    assert!(hits > 0 || loaded.mesh().triangles().is_empty(), "{name}: nothing was hit");
}

#[test]
fn made_meshes_answer_alike() {
    let soup = meshes::mesh(meshes::soup(3000, [0.0; 3], 1.0, 1));
    let rays = Archer::new(&soup, 2).all_kinds(40, 10.0);
    for options in Preset::ALL.map(BuildOptions::preset) {
        check("soup", soup.clone(), &options, &rays);
    }
    check("soup", soup.clone(), &BuildOptions::for_strategy(Strategy::Median), &rays);
    let nothing: TriangleMesh = TriangleMesh::default();
    check("nothing", nothing, &BuildOptions::default(), &rays);
}

#[test]
fn made_meshes_in_f64_answer_alike() {
    let place = [500_000.0, 5_400_000.0, 100.0];
    let far = meshes::mesh(meshes::placed(&meshes::soup(1000, [0.0; 3], 1.0, 1), 0.1, place));
    let rays = Archer::new(&far, 2).all_kinds(20, 10.0);
    check("far", far.clone(), &BuildOptions::default(), &rays);
    check("far", far, &BuildOptions::for_strategy(Strategy::Median), &rays);
    let nothing: TriangleMesh<f64> = TriangleMesh::default();
    check("nothing", nothing, &BuildOptions::default(), &rays);
    for scale in [1e-300, 1e300] {
        let mesh = meshes::mesh(meshes::placed(&meshes::degenerate(3), scale, [0.0; 3]));
        let rays = Archer::new(&mesh, 4).all_kinds(4, 10.0);
        check("of odd size", mesh, &BuildOptions::default(), &rays);
    }
}

#[test]
fn real_scenes_answer_alike() {
    let Some(scenes) = shared::scenes() else { return };
    let small = scenes.iter().filter(|scene| scene.triangles <= 120_000);
    let mut checked = 0;
    for scene in small {
        let mesh = shared::load_mesh(scene).unwrap_or_else(|error| panic!("{error}"));
        if mesh.triangles().is_empty() {
            continue;
        }
        let rays = Archer::new(&mesh, 3).all_kinds(20, 10.0);
        check(&scene.name, mesh, &BuildOptions::default(), &rays);
        checked += 1;
    }
    assert!(checked > 10, "{checked} scenes");
}
