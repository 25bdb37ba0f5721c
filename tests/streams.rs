//! Batches that are streamed: of unknown length, within each other, and with rays out of range.

use kdray::{BuildOptions, Coordinate, Hit, Precision, Ray, Scene};
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
