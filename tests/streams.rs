//! Batches that are streamed: of unknown length, within each other, and with rays out of range; and those that several
//! threads share.

use kdray::{BuildOptions, Coordinate, Hit, Instance, InstancedScene, Precision, Ray, Scene};
use kdray_tests::bits::Bits;
use kdray_tests::{meshes, rays::Archer};

/// A scene, and rays of all kinds, some of which no kernel takes or nothing hits.
fn scene_and_rays<T: Precision>() -> (Scene<T>, Vec<Ray>) {
    let soup = meshes::mesh(meshes::soup(300, [0.0; 3], 1.0, 1));
    // No f32, if there is room for more.
    let mesh = meshes::moved(&soup, |p| p.map(|x| <T as Coordinate>::from_f64(x / 3.0)));
    let mut rays = Archer::new(&mesh, 2).all_kinds(20, 10.0);
    for (i, far) in [1e30, 1e300, f64::NAN, f64::INFINITY].into_iter().enumerate() {
        let out_of_range = [
            Ray::new([far, 0.0, 0.0], [-1.0, 0.0, 0.0]),
            Ray::new([0.1, 0.0, -9.0], [0.0, 0.0, far]),
            Ray::new([0.1, 0.0, -9.0], [0.0, 0.0, 1.0]).with_interval(far, 0.0),
        ];
        // Among the others, not behind them.
        let place = rays.len() / 2 + i;
        rays.splice(place..place, out_of_range);
    }
    let scene = Scene::build(mesh, &BuildOptions::default()).expect("a small mesh");
    assert!(scene.wide_tree().is_some());
    (scene, rays)
}

/// The hits of a stream by the numbers of its rays; each came once.
fn closest<T: Precision>(
    scene: &Scene<T>,
    rays: impl Iterator<Item = Ray>,
    count: usize,
) -> Vec<Option<Hit>> {
    let mut hits = vec![None; count];
    scene.each_closest_hit(rays, |index, hit| {
        assert!(hits[index].replace(hit).is_none(), "{index} comes twice");
    });
    hits.into_iter().map(|hit| hit.expect("each comes")).collect()
}

fn one_by_one<T: Precision>(scene: &Scene<T>, rays: &[Ray]) -> Vec<Option<Hit>> {
    rays.iter().map(|ray| scene.closest_hit(ray)).collect()
}

#[test]
fn rays_out_of_range_are_answered_among_others() {
    out_of_range::<f32>();
    out_of_range::<f64>();
}

fn out_of_range<T: Precision>() {
    let (scene, rays) = scene_and_rays::<T>();
    let naive: Vec<_> = rays.iter().map(|ray| scene.shapes().naive().closest_hit(ray)).collect();
    assert!(naive.iter().any(Option::is_some) && naive.iter().any(Option::is_none));
    let (mut hits, mut found) = (vec![None; rays.len()], vec![false; rays.len()]);
    scene.closest_hits(&rays, &mut hits);
    scene.any_hits(&rays, &mut found);
    assert_eq!(hits, naive);
    assert!(found.iter().zip(&naive).all(|(&found, hit)| found == hit.is_some()));
}

#[test]
fn streams_of_unknown_length_of_any_length() {
    of_unknown_length::<f32>();
    of_unknown_length::<f64>();
}

fn of_unknown_length<T: Precision>() {
    let (scene, rays) = scene_and_rays::<T>();
    let expected = one_by_one(&scene, &rays);
    for count in [0, 1, 7, 8, 16, 17, 100, rays.len()] {
        let mut rest = rays[..count].iter();
        let unknown = std::iter::from_fn(|| rest.next().copied());
        assert_eq!(unknown.size_hint(), (0, None));
        assert_eq!(closest(&scene, unknown, count), expected[..count], "{count}");
    }
}

#[test]
fn what_a_batch_calls_may_ask_the_scene() {
    asked_from_within::<f32>();
    asked_from_within::<f64>();
}

fn asked_from_within<T: Precision>() {
    let (scene, rays) = scene_and_rays::<T>();
    let expected = one_by_one(&scene, &rays);
    let few = &rays[..20];
    // Each ray is only made when another batch was answered.
    let made = rays.iter().map(|&ray| {
        assert_eq!(closest(&scene, few.iter().copied(), few.len()), expected[..few.len()]);
        ray
    });
    let mut came = 0;
    scene.each_closest_hit(made, |index, hit| {
        came += 1;
        assert_eq!(hit, expected[index]);
        assert_eq!(scene.closest_hit(&rays[index]), hit);
        assert_eq!(closest(&scene, few.iter().copied(), few.len()), expected[..few.len()]);
        scene.each_any_hit(few, |index, is_hit| assert_eq!(is_hit, expected[index].is_some()));
    });
    assert_eq!(came, rays.len());
}

/// So many rays and points that they are handed out in three pieces or more, the last of which is not whole.
const MANY_RAYS: usize = 3 * 4096 - 50;
const MANY_POINTS: usize = 3 * 1024 - 50;

/// What several threads say, where at first there is `before`.
fn shared<A: Clone + Send>(count: usize, before: A, ask: impl FnOnce(&mut [A]) + Send) -> Vec<A> {
    let mut answers = vec![before; count];
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().expect("threads");
    pool.install(|| ask(&mut answers));
    answers
}

fn many_rays<T: Precision>(scene: &Scene<T>) -> Vec<Ray> {
    let rays = Archer::new(scene.mesh(), 3).all_kinds(1200, 10.0);
    assert!(rays.len() >= MANY_RAYS);
    rays[..MANY_RAYS].to_vec()
}

#[test]
fn threads_share_rays() {
    rays_are_shared::<f32>();
    rays_are_shared::<f64>();
}

fn rays_are_shared<T: Precision>() {
    let (scene, _) = scene_and_rays::<T>();
    let (rays, count) = (many_rays(&scene), MANY_RAYS);
    let closest = shared(count, None, |it| scene.par_closest_hits(&rays, it));
    assert!(closest.is_same(&one_by_one(&scene, &rays)));
    let any = shared(count, false, |it| scene.par_any_hits(&rays, it));
    assert!(any.iter().zip(&closest).all(|(&any, hit)| any == hit.is_some()));
    let counts = shared(count, usize::MAX, |it| scene.par_counts(&rays, it));
    let alone: Vec<_> = rays.iter().map(|ray| scene.count(ray)).collect();
    assert!(counts == alone && alone.contains(&0) && alone.iter().any(|&count| count > 1));
}

#[test]
fn threads_share_points() {
    points_are_shared::<f32>();
    points_are_shared::<f64>();
}

fn points_are_shared<T: Precision>() {
    let round = meshes::moved(&meshes::sphere(12), |p| p.map(|x| T::from_f64(x / 3.0)));
    let scene = Scene::build(round, &BuildOptions::default()).expect("a small mesh");
    let random = kdray_tests::points::points(scene.mesh(), 130, 10.0, 5);
    assert!(random.len() >= MANY_POINTS);
    let (points, count) = (&random[..MANY_POINTS], MANY_POINTS);
    let inside = shared(count, false, |it| scene.par_contains_each(points, it));
    assert!(points.iter().zip(&inside).all(|(&p, &inside)| inside == scene.contains(p)));
    assert!(inside.contains(&true) && inside.contains(&false));
    let closest = shared(count, None, |it| scene.par_closest_points(points, it));
    assert!(points.iter().zip(&closest).all(|(&p, found)| *found == scene.closest_point(p)));
    let signed = shared(count, None, |it| scene.par_signed_distances(points, it));
    assert!(points.iter().zip(&signed).all(|(&p, found)| *found == scene.signed_distance(p)));
    let winding = shared(count, f64::NAN, |it| scene.par_winding_numbers(points, it));
    assert!(points.iter().zip(&winding).all(|(&p, &found)| found == scene.winding_number(p)));
}

#[test]
fn threads_share_rays_at_copies() {
    copies_are_shared::<f32>();
    copies_are_shared::<f64>();
}

fn copies_are_shared<T: Precision>() {
    let (scene, _) = scene_and_rays::<T>();
    let (rays, count) = (many_rays(&scene), MANY_RAYS);
    let copies = (0..3).map(|i| Instance::of(0).moved([f64::from(i), 0.0, 0.5])).collect();
    let scene = InstancedScene::build(vec![scene], copies).expect("copies nearby");
    let closest = shared(count, None, |it| scene.par_closest_hits(&rays, it));
    assert!(rays.iter().zip(&closest).all(|(ray, hit)| *hit == scene.closest_hit(ray)));
    let any = shared(count, false, |it| scene.par_any_hits(&rays, it));
    assert!(any.iter().zip(&closest).all(|(&any, hit)| any == hit.is_some()));
    assert!(any.contains(&true) && any.contains(&false));
}
