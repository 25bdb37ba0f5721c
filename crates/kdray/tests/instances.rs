//! Placed copies of meshes, against the same triangles in one mesh, and against every copy asked in turn.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use kdray::query::{InstanceError, InstancedSceneError};
use kdray::{
    BuildError, BuildOptions, Hit, Instance, InstanceHit, InstancedScene, Precision, Ray, Scene,
    TriangleMesh,
};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::ops::ControlFlow;
use std::sync::Mutex;

/// The cube from −1 to 1, closed, its fronts outside.
fn cube() -> TriangleMesh {
    let vertices = (0..8).map(|i| [1, 2, 4].map(|bit| if i & bit == 0 { -1.0 } else { 1.0 }));
    let quads =
        [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    TriangleMesh::new(vertices.collect(), triangles.collect()).unwrap()
}

/// Triangles here and there, on a grid so fine that f32 holds them where they are placed.
fn shards(count: u32, random: &mut impl Rng) -> TriangleMesh {
    let mut coordinate = || f32::from(random.random_range(-256..256_i16)) / 256.0;
    let vertices: Vec<_> = (0..3 * count).map(|_| [(); 3].map(|()| coordinate())).collect();
    let triangles = (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
    TriangleMesh::new(vertices, triangles.collect()).unwrap()
}

/// The mesh in another precision, moved.
fn cast<T: Precision>(mesh: &TriangleMesh, offset: [f64; 3]) -> TriangleMesh<T> {
    let place = |p: &[f32; 3]| [0, 1, 2].map(|k| T::from_f64(f64::from(p[k]) + offset[k]));
    let vertices = mesh.vertices().iter().map(place).collect();
    TriangleMesh::new(vertices, mesh.triangles().to_vec()).unwrap()
}

/// Where f32 would round: a place in a national grid.
const FAR: [f64; 3] = [500_000.0, 5_400_000.0, 128.0];

fn scene<T: Precision>(mesh: TriangleMesh<T>) -> Scene<T> {
    Scene::build(mesh, &BuildOptions::default()).unwrap()
}

/// A matrix of small whole numbers and halves, by which f64 moves the meshes here without rounding.
fn exact_matrix(random: &mut impl Rng) -> [[f64; 4]; 3] {
    let mut rows = [[0.0; 4]; 3];
    let turn = random.random_range(0..3);
    for (i, row) in rows.iter_mut().enumerate() {
        let sign = if random.random() { 1.0 } else { -1.0 };
        row[(i + turn) % 3] = sign * [0.5, 1.0, 2.0][random.random_range(0..3)];
        row[3] = f64::from(random.random_range(-6..7));
    }
    rows
}

/// The mesh as the matrix places it.
fn placed<T: Precision>(mesh: &TriangleMesh<T>, rows: &[[f64; 4]; 3]) -> Vec<[T; 3]> {
    let place = |p: &[T; 3]| {
        rows.map(|[x, y, z, w]| {
            let [px, py, pz] = p.map(T::to_f64);
            T::from_f64(x * px + y * py + z * pz + w)
        })
    };
    mesh.vertices().iter().map(place).collect()
}

fn random_ray(random: &mut impl Rng, reach: f64) -> Ray {
    let mut point = || [(); 3].map(|()| random.random_range(-reach..reach));
    Ray::through(point(), point()).with_interval(0.0, f64::INFINITY)
}

/// Which triangles are hit, and where: by id, since hits of one t may swap their order, which rounds
/// otherwise in a turned space.
fn by_id(hits: impl Iterator<Item = (u32, f64)>) -> (Vec<u32>, Vec<f64>) {
    let mut hits: Vec<_> = hits.collect();
    hits.sort_unstable_by_key(|&(id, _)| id);
    hits.into_iter().unzip()
}

fn are_close(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-12 * a.abs())
}

#[test]
fn copies_are_hit_as_their_triangles_in_one_mesh() {
    copies_are_triangles::<f32>([0.0; 3], 4000);
    copies_are_triangles::<f64>(FAR, 1000);
}

fn copies_are_triangles<T: Precision>(offset: [f64; 3], rays: usize) {
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let geometries = [cube(), shards(50, &mut random)].map(|mesh| cast::<T>(&mesh, [0.0; 3]));
    let mut matrix = || {
        let mut rows = exact_matrix(&mut random);
        rows.iter_mut().zip(offset).for_each(|(row, offset)| row[3] += offset);
        rows
    };
    let instances: Vec<Instance> = (0..40).map(|i| Instance::of(i % 2).placed(matrix())).collect();
    let (mut vertices, mut triangles, mut firsts) = (Vec::new(), Vec::new(), Vec::new());
    for instance in &instances {
        let mesh = &geometries[instance.geometry_id as usize];
        let first = vertices.len() as u32;
        firsts.push(triangles.len() as u32);
        vertices.extend(placed(mesh, &instance.to_world));
        triangles.extend(mesh.triangles().iter().map(|t| t.map(|vertex| first + vertex)));
    }
    let one = scene(TriangleMesh::new(vertices, triangles).unwrap());
    let copies = InstancedScene::build(geometries.map(scene).to_vec(), instances).unwrap();

    let mut hits = 0;
    for i in 0..rays {
        let mut ray = random_ray(&mut random, 9.0);
        // Carried without rounding; every second one along the grid, into faces, edges and vertices.
        let steps = if i % 2 == 0 { 1.0 } else { 1024.0 };
        ray.origin = [0, 1, 2].map(|k| (ray.origin[k] * steps).round() / steps + offset[k]);
        ray.direction = ray.direction.map(|x| (x / 6.0 * steps).round() / steps);
        if ray.check().is_err() {
            continue;
        }
        let closest = copies.closest_hit(&ray);
        hits += usize::from(closest.is_some());
        assert_eq!(closest, copies.all_touched(&ray).next());
        assert_eq!(copies.any_hit(&ray), closest.is_some());
        let (ids, t) = by_id(copies.all_touched(&ray).map(|found| {
            (firsts[found.instance_id as usize] + found.hit.primitive_id, found.hit.t)
        }));
        let (expected, expected_t) =
            by_id(one.all_touched(&ray).map(|hit| (hit.primitive_id, hit.t)));
        assert_eq!(ids, expected, "{ray:?}");
        assert!(are_close(&t, &expected_t), "{ray:?}");
    }
    assert!(hits > rays / 4, "{hits}");
}

/// The ray in the space of an instance.
fn carried(instance: &Instance, ray: &Ray) -> Ray {
    let column = |k: usize| glam::DVec3::from(instance.to_world.map(|row| row[k]));
    let to_world = glam::DAffine3::from_cols(column(0), column(1), column(2), column(3));
    let to_object = to_world.inverse();
    Ray {
        origin: to_object.transform_point3(ray.origin.into()).into(),
        direction: to_object.transform_vector3(ray.direction.into()).into(),
        interval: ray.interval,
    }
}

/// What each geometry says of the carried ray, whether or not the ray meets any box.
fn naive<T: Precision>(scene: &InstancedScene<T>, ray: &Ray) -> Vec<InstanceHit> {
    let alone = |(index, instance): (usize, &Instance)| {
        let geometry = &scene.geometries()[instance.geometry_id as usize];
        let found =
            |hit| InstanceHit { hit, instance_id: index as u32, geometry_id: instance.geometry_id };
        geometry.all_touched(&carried(instance, ray)).map(found).collect::<Vec<_>>()
    };
    let mut all: Vec<_> = scene.instances().iter().enumerate().flat_map(alone).collect();
    all.sort_by(InstanceHit::order);
    all
}

#[test]
fn any_matrix_gives_what_each_copy_gives_alone() {
    copies_are_alike::<f32>([0.0; 3], [0.0; 3], 2000);
    copies_are_alike::<f64>([0.0; 3], FAR, 300);
    copies_are_alike::<f64>(FAR, [0.0; 3], 300);
    copies_are_alike::<f64>(FAR, FAR, 300);
}

/// Copies of geometries around one place, around another.
fn copies_are_alike<T: Precision>(from: [f64; 3], to: [f64; 3], rays: usize) {
    let mut random = Pcg64Mcg::seed_from_u64(2);
    let geometries = [cube(), shards(30, &mut random)].map(|mesh| scene(cast::<T>(&mesh, from)));
    let instances: Vec<Instance> = (0..40)
        .map(|i| {
            // Every second one is squeezed towards a line, as much as is not refused.
            let squeezed = if i % 4 < 2 { 1e-3 } else { 1.0 };
            let axis = [(); 3].map(|()| random.random_range(-1.0..1.0));
            let row = |k: usize| {
                let along: [f64; 3] = axis.map(|a| 2.0 * a * axis[k]);
                let [x, y, z] = along.map(|a| a + squeezed * random.random_range(-1.0..1.0));
                let there = x * from[0] + y * from[1] + z * from[2];
                [x, y, z, random.random_range(-2.0..2.0) + to[k] - there]
            };
            Instance::of(i % 2).placed([0, 1, 2].map(row))
        })
        .collect();
    let scene = InstancedScene::build(geometries.to_vec(), instances).unwrap();
    let (mut asked, mut answers) = (Vec::new(), Vec::new());
    for round in 0..rays {
        let mut ray = random_ray(&mut random, 8.0);
        ray.origin = [0, 1, 2].map(|k| ray.origin[k] + to[k]);
        if round % 4 == 0 {
            let back = ray.direction.map(|d| 1e3 * d);
            ray.origin = [0, 1, 2].map(|k| ray.origin[k] - back[k]);
        }
        let expected = naive(&scene, &ray);
        assert_eq!(scene.all_touched(&ray).collect::<Vec<_>>(), expected);
        assert_eq!(scene.closest_hit(&ray).as_ref(), expected.first());
        assert_eq!(scene.any_hit(&ray), !expected.is_empty());
        let (crossed, mut at_once) = (scene.all_hits(&ray).collect::<Vec<_>>(), Vec::new());
        scene.all_hits_into(&ray, &mut at_once);
        assert_eq!((scene.count(&ray), &at_once), (crossed.len(), &crossed));
        asked.push(ray);
        answers.push(expected.first().copied());
    }
    assert_batches(&scene, &asked, &answers);
}

/// Many rays are answered like each alone.
fn assert_batches<T: Precision>(
    scene: &InstancedScene<T>,
    rays: &[Ray],
    answers: &[Option<InstanceHit>],
) {
    let (mut hits, mut found) = (vec![None; rays.len()], vec![false; rays.len()]);
    scene.closest_hits(rays, &mut hits);
    scene.any_hits(rays, &mut found);
    assert_eq!(hits, answers);
    assert!(found.iter().zip(answers).all(|(found, answer)| *found == answer.is_some()));
    #[cfg(feature = "rayon")]
    {
        let (mut par_hits, mut par_found) = (vec![None; rays.len()], vec![false; rays.len()]);
        scene.par_closest_hits(rays, &mut par_hits);
        scene.par_any_hits(rays, &mut par_found);
        assert_eq!((par_hits, par_found), (hits, found));
    }
}

#[test]
fn an_instance_where_it_is_is_met_as_its_geometry_at_any_size() {
    let mut random = Pcg64Mcg::seed_from_u64(5);
    let shards = shards(60, &mut random);
    for scale in [1e-290, 1e-3, 1e290] {
        let vertices = shards.vertices().iter().map(|p| p.map(|x| f64::from(x) * scale / 3.0));
        let mesh = TriangleMesh::new(vertices.collect(), shards.triangles().to_vec()).unwrap();
        let alone = scene(mesh);
        let there = InstancedScene::build(vec![alone.clone()], vec![Instance::of(0)]).unwrap();
        let mut hits = 0;
        for _ in 0..100 {
            let ray = random_ray(&mut random, 0.5);
            let (origin, direction) = (ray.origin.map(|x| x * scale), ray.direction);
            let ray = Ray::new(origin, direction.map(|x| x * scale));
            let expected = alone.closest_hit(&ray);
            hits += usize::from(expected.is_some());
            assert_eq!(there.closest_hit(&ray).map(|found| found.hit), expected, "{scale}");
            assert_eq!(there.count(&ray), alone.count(&ray), "{scale}");
        }
        assert!(hits > 20, "{scale}: {hits}");
    }
}

#[test]
fn closed_copies_are_crossed_an_even_number_of_times() {
    let mut random = Pcg64Mcg::seed_from_u64(3);
    let row = |random: &mut Pcg64Mcg| [(); 4].map(|()| random.random_range(-2.0..2.0));
    let instances: Vec<_> =
        (0..30).map(|_| Instance::of(0).placed([(); 3].map(|()| row(&mut random)))).collect();
    let scene = InstancedScene::build(vec![scene(cube())], instances).unwrap();
    let mut crossed = 0;
    for _ in 0..2000 {
        let target = random_ray(&mut random, 2.0).origin;
        let ray = Ray::through([100.0, 3.0, -2.0], target).with_interval(0.0, f64::INFINITY);
        let count = scene.count(&ray);
        assert_eq!(count % 2, 0, "{ray:?}");
        crossed += count;
    }
    assert!(crossed > 100, "{crossed}");
}

#[test]
fn masks_hide_instances() {
    let at = |x: f64, mask| Instance::of(0).moved([x, 0.0, 0.0]).masked(mask);
    let scene = InstancedScene::build(vec![scene(cube())], vec![at(0.0, 1), at(10.0, 2)]).unwrap();
    let ray = Ray::new([-5.0, 0.25, 0.5], [1.0, 0.0, 0.0]);
    let seen = |mask| {
        let scene = scene.clone().with_mask(mask);
        let closest = scene.closest_hit(&ray).map(|found| found.instance_id);
        assert_eq!(scene.any_hit(&ray), closest.is_some());
        (closest, scene.count(&ray))
    };
    assert_eq!([1, 2, 3, 4].map(seen), [(Some(0), 2), (Some(1), 2), (Some(0), 4), (None, 0)]);
}

#[test]
fn normals_are_those_of_the_placed_triangles() {
    let mut random = Pcg64Mcg::seed_from_u64(4);
    for _ in 0..20 {
        let rows = exact_matrix(&mut random);
        let instance = Instance::of(0).placed(rows);
        let copy = InstancedScene::build(vec![scene(cube())], vec![instance]).unwrap();
        let mesh = TriangleMesh::new(placed(&cube(), &rows), cube().triangles().to_vec()).unwrap();
        let [x, y, z] = [0, 1, 2].map(|k| glam::DVec3::new(rows[0][k], rows[1][k], rows[2][k]));
        let mirrored = x.cross(y).dot(z) < 0.0;
        for id in 0..12 {
            let hit = Hit { t: 0.0, primitive_id: id, u: 0.0, v: 0.0, side: kdray::Side::Front };
            let found = InstanceHit { hit, instance_id: 0, geometry_id: 0 };
            let of_mesh = glam::DVec3::from(mesh.geometric_normal(id));
            let expected = if mirrored { -of_mesh } else { of_mesh };
            assert!(expected.distance(copy.geometric_normal(&found).into()) < 1e-12);
        }
    }
}

#[test]
fn ten_thousand_copies_share_one_tree() {
    let instances: Vec<_> = (0..10_000_u32)
        .map(|i| Instance::of(0).moved([f64::from(4 * (i % 100)), f64::from(4 * (i / 100)), 0.0]))
        .collect();
    let scene = InstancedScene::build(vec![scene(cube())], instances).unwrap();
    assert_eq!((scene.geometries().len(), scene.instances().len()), (1, 10_000));
    // Of the tree over them; what is kept of each besides does not depend on the geometry.
    let tree = scene.tree();
    let references = tree.stats(10_000, &kdray::CostModel::default()).references;
    let bytes = 8 * tree.nodes().len() + 4 * references;
    assert!(bytes < 40 * 10_000, "{bytes}");
    for i in 0..10_000_u32 {
        let (x, y) = (f64::from(4 * (i % 100)), f64::from(4 * (i / 100)));
        let ray = Ray::new([x + 0.25, y + 0.5, 9.0], [0.0, 0.0, -1.0]);
        let found = scene.closest_hit(&ray).unwrap();
        assert_eq!((found.instance_id, found.hit.t), (i, 8.0));
    }
}

#[test]
fn copies_far_from_zero_are_told_apart() {
    // At 5,400,000 numbers of f32 are half a metre apart.
    let place = |i: u32| [FAR[0] + 0.5 * f64::from(i % 30), FAR[1] + 0.5 * f64::from(i / 30), 0.0];
    let row = |axis: usize, offset: f64| {
        let mut row = [0.0, 0.0, 0.0, offset];
        row[axis] = 0.05;
        row
    };
    let copy = |i: u32| {
        let [x, y, z] = place(i);
        Instance::of(0).placed([row(0, x), row(1, y), row(2, z)])
    };
    let scene = InstancedScene::build(vec![scene(cube())], (0..900).map(copy).collect()).unwrap();
    let references = scene.tree().stats(900, &kdray::CostModel::default()).references;
    assert!(references < 3 * 900, "{references}");
    for i in 0..900 {
        let [x, y, _] = place(i);
        let found = scene.closest_hit(&Ray::new([x, y, 9.0], [0.0, 0.0, -1.0])).unwrap();
        assert_eq!(found.instance_id, i);
        assert!(!scene.any_hit(&Ray::new([x + 0.25, y, 9.0], [0.0, 0.0, -1.0])));
    }
    // Beyond f32, too.
    far_copies_are_there::<f32>();
    far_copies_are_there::<f64>();
}

fn far_copies_are_there<T: Precision>() {
    let cube = scene(cast::<T>(&cube(), [0.0; 3]));
    let nothing = scene(TriangleMesh::<T>::default());
    for place in [1e39, 1e60, 1e300] {
        for geometries in [vec![cube.clone()], vec![cube.clone(), nothing.clone()]] {
            let copies =
                (0..geometries.len() as u32).map(|id| Instance::of(id).moved([place, 0.0, 0.0]));
            let there = InstancedScene::build(geometries, copies.collect()).unwrap();
            assert_eq!(
                there.count(&Ray::new([place, 0.25, 9.0], [0.0, 0.0, -1.0])),
                2,
                "{place:e}"
            );
        }
    }
}

#[test]
fn a_build_can_be_watched_stopped_and_limited() {
    let copies: Vec<_> =
        (0..20_000_u32).map(|i| Instance::of(0).moved([f64::from(3 * i), 0.0, 0.0])).collect();
    let geometry = vec![scene(cube())];
    let told = Mutex::new(Vec::new());
    let build = |limit: Option<u64>, last: f64| {
        InstancedScene::build_with_progress(geometry.clone(), copies.clone(), limit, &|done| {
            told.lock().unwrap().push(done.fraction);
            if done.fraction > last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
        .map(|_| ())
    };
    assert_eq!(InstancedScene::<f32>::peak_bytes(usize::MAX), u64::MAX);
    let needed = InstancedScene::<f32>::peak_bytes(20_000);
    assert_eq!(build(Some(needed), 1.0), Ok(()));
    let told_to_the_end = std::mem::take(&mut *told.lock().unwrap());
    assert!(told_to_the_end.is_sorted() && told_to_the_end.last() == Some(&1.0));
    assert!(told_to_the_end.iter().filter(|&&done| done < 0.25).count() > 2);
    let limit = needed - 1;
    assert_eq!(build(Some(limit), 1.0), Err(BuildError::Memory { needed, limit }.into()));
    assert!(told.lock().unwrap().is_empty());
    for last in [0.1, 0.5] {
        assert_eq!(build(None, last), Err(BuildError::Cancelled.into()));
    }
}

#[test]
fn what_cannot_be_placed_is_refused() {
    let refused = |instance: Instance| {
        let error = InstancedScene::build(vec![scene(cube())], vec![instance]).unwrap_err();
        assert!(error.to_string().contains("; "), "it does not say what to do: {error}");
        let InstancedSceneError::Instance(error) = error else { panic!("{error}") };
        error
    };
    let flat = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0; 4]];
    assert_eq!(refused(Instance::of(0).placed(flat)), InstanceError::Singular(0));
    let nearly = [[0.3, 0.7, 0.2, 0.0], [0.6, 1.4, 0.4 + 1e-9, 0.0], [0.9, 2.1 + 1e-9, 0.6, 0.0]];
    assert_eq!(refused(Instance::of(0).placed(nearly)), InstanceError::Singular(0));
    let nowhere = Instance::of(0).moved([f64::NAN, 0.0, 0.0]);
    assert_eq!(refused(nowhere), InstanceError::Singular(0));
    let far = [[1e308, 0.0, 0.0, 1.7e308], [0.0, 1e308, 0.0, 0.0], [0.0, 0.0, 1e308, 0.0]];
    assert_eq!(refused(Instance::of(0).placed(far)), InstanceError::OutOfRange(0));
    let missing = InstanceError::NoSuchGeometry { instance: 0, geometry_id: 1, geometries: 1 };
    assert_eq!(refused(Instance::of(1)), missing);
}

#[test]
fn what_is_empty_does_not_stretch_the_scene() {
    let empty = scene(TriangleMesh::<f64>::new(Vec::new(), Vec::new()).unwrap());
    let far = scene(cast::<f64>(&cube(), [1000.0; 3]));
    let instances =
        vec![Instance::of(0), Instance::of(1), Instance::of(0).moved([-1e52, 0.0, 0.0])];
    let scene = InstancedScene::build(vec![empty, far.clone()], instances).unwrap();
    let alone = InstancedScene::build(vec![far], vec![Instance::of(0)]).unwrap();
    assert_eq!(scene.tree_space(), alone.tree_space());
    assert_eq!(scene.tree().bounds(), alone.tree().bounds());
    let ray = Ray::new([1000.25, 1000.5, 0.0], [0.0, 0.0, 1.0]);
    assert_eq!(scene.count(&ray), 2);
    assert_eq!(scene.closest_hit(&ray).map(|found| found.instance_id), Some(1));
}

#[test]
fn nothing_is_hit_where_nothing_is() {
    let empty = scene(TriangleMesh::<f32>::default());
    let ray = Ray::new([0.0; 3], [1.0, 0.0, 0.0]);
    for instances in [vec![], vec![Instance::of(0)]] {
        let scene = InstancedScene::build(vec![empty.clone()], instances).unwrap();
        assert_eq!(
            (scene.closest_hit(&ray), scene.any_hit(&ray), scene.count(&ray)),
            (None, false, 0)
        );
    }
}
