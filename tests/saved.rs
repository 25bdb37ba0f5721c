//! Scenes that are saved, loaded and mapped answer with the same bits as those that were built.

use kdray::TriangleMesh;
use kdray::geometry::RayPacket;
use kdray::primitives::HitArrays;
use kdray::{BuildOptions, ClosestPoint, Hit, Precision, Preset, Ray, Scene, Strategy};
use kdray_tests::{meshes, points, rays::Archer, shared};
use std::fs;
use tempfile::TempDir;

/// The bits of a hit.
type Bits = (u64, u32, u64, u64, bool);

fn bits(hit: Hit) -> Bits {
    let is_front = hit.side == kdray::Side::Front;
    (hit.t.to_bits(), hit.primitive_id, hit.u.to_bits(), hit.v.to_bits(), is_front)
}

/// The bits of a nearest point.
type PointBits = ([u64; 6], u32);

fn point_bits(found: ClosestPoint) -> PointBits {
    let ClosestPoint { point: [x, y, z], distance, primitive_id, u, v } = found;
    ([x, y, z, distance, u, v].map(f64::to_bits), primitive_id)
}

/// What is asked of a scene.
struct Asked {
    rays: Vec<Ray>,
    points: Vec<[f64; 3]>,
}

impl Asked {
    /// Rays and points about a mesh, so many of each kind.
    fn about<T: Precision>(mesh: &TriangleMesh<T>, each: usize, seed: u64) -> Self {
        let rays = Archer::new(mesh, seed).all_kinds(each, 10.0);
        Self { rays, points: points::points(mesh, each.div_ceil(10), 10.0, seed) }
    }
}

/// All that a scene answers to rays, and about points.
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
    nearest: Vec<Option<PointBits>>,
    inside: Vec<bool>,
    signed: Vec<Option<u64>>,
    winding: Vec<u64>,
}

impl Answers {
    fn of<T: Precision>(scene: &Scene<T>, Asked { rays, points }: &Asked) -> Self {
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
            nearest: points.iter().map(|&p| scene.closest_point(p).map(point_bits)).collect(),
            inside: points.iter().map(|&p| scene.contains(p)).collect(),
            signed: points.iter().map(|&p| scene.signed_distance(p).map(f64::to_bits)).collect(),
            winding: points.iter().map(|&p| scene.winding_number(p).to_bits()).collect(),
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
fn check<T: Precision>(name: &str, mesh: TriangleMesh<T>, options: &BuildOptions, asked: &Asked) {
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
    let expected = Answers::of(&built, asked);
    assert!(Answers::of(&loaded, asked) == expected, "{name}: loaded it answers otherwise");
    assert!(Answers::of(&mapped, asked) == expected, "{name}: mapped it answers otherwise");
    let hits = expected.closest.iter().flatten().count() + expected.all.iter().flatten().count();
    let is_empty = loaded.mesh().triangles().is_empty();
    assert!(hits > 0 || is_empty, "{name}: nothing was hit");
    let has_nearest = expected.nearest.iter().all(Option::is_some);
    assert!(has_nearest || is_empty, "{name}: a point has no nearest one");
}

#[test]
fn made_meshes_answer_alike() {
    let soup = meshes::mesh(meshes::soup(3000, [0.0; 3], 1.0, 1));
    let asked = Asked::about(&soup, 40, 2);
    for options in Preset::ALL.map(BuildOptions::preset) {
        check("soup", soup.clone(), &options, &asked);
    }
    check("soup", soup.clone(), &BuildOptions::for_strategy(Strategy::Median), &asked);
    let nothing: TriangleMesh = TriangleMesh::default();
    check("nothing", nothing, &BuildOptions::default(), &asked);
}

/// Of a closed mesh another way leads to what is inside than of an open one.
#[test]
fn closed_meshes_answer_alike() {
    let torus = meshes::torus(40, 20);
    let asked = Asked::about(&torus, 40, 5);
    check("torus", torus.clone(), &BuildOptions::default(), &asked);
    let in_f64 = meshes::moved(&torus, |p| p.map(|x| x / 3.0));
    let asked = Asked::about(&in_f64, 40, 6);
    check("torus in f64", in_f64, &BuildOptions::default(), &asked);
}

#[test]
fn made_meshes_in_f64_answer_alike() {
    let place = [500_000.0, 5_400_000.0, 100.0];
    let far = meshes::mesh(meshes::placed(&meshes::soup(1000, [0.0; 3], 1.0, 1), 0.1, place));
    let asked = Asked::about(&far, 20, 2);
    check("far", far.clone(), &BuildOptions::default(), &asked);
    check("far", far, &BuildOptions::for_strategy(Strategy::Median), &asked);
    let nothing: TriangleMesh<f64> = TriangleMesh::default();
    check("nothing", nothing, &BuildOptions::default(), &asked);
    for scale in [1e-300, 1e300] {
        let mesh = meshes::mesh(meshes::placed(&meshes::degenerate(3), scale, [0.0; 3]));
        let asked = Asked::about(&mesh, 4, 4);
        check("of odd size", mesh, &BuildOptions::default(), &asked);
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
        let asked = Asked::about(&mesh, 20, 3);
        check(&scene.name, mesh, &BuildOptions::default(), &asked);
        checked += 1;
    }
    assert!(checked > 10, "{checked} scenes");
}
