//! The nodes that wait on the traversal's stack were taken to be sorted by t_near. They are not
//! when the ray runs in a split plane, and so visits all cells on one side before those on the
//! other: the search for the closest hit ended too early, and hits came out of order.

use kdray::primitives::Segments;
use kdray::{BuildOptions, Hit, Ray, ShapeScene, Strategy};
use kdray_tests::meshes;

#[test]
fn of_equally_near_hits_on_both_sides_of_a_split_plane_the_smaller_id_wins() {
    let options = BuildOptions { leaf_size: 1, ..BuildOptions::for_strategy(Strategy::Sah) };
    let scene = ShapeScene::build(meshes::mesh(meshes::grid(6, 3)), &options).unwrap();
    let ray = Ray::new([3.0, 1.0, 11.921501120694394], [-0.0, 0.0, -1.0]);
    assert_eq!(scene.closest_hit(&ray), scene.naive().closest_hit(&ray));
}

#[test]
fn hits_of_a_ray_in_a_split_plane_rise() {
    // Rungs on alternating sides of the line x = 0, in which the ray runs and touches them all.
    let rung = |i: i16| [[0.0, f32::from(i)], [if i % 2 == 0 { 1.0 } else { -1.0 }, f32::from(i)]];
    let segments = Segments::new((0..40).map(rung).collect()).unwrap();
    for strategy in Strategy::ALL {
        let options = BuildOptions { leaf_size: 1, ..BuildOptions::for_strategy(strategy) };
        let scene = ShapeScene::build(segments.clone(), &options).unwrap();
        let ray = Ray::new([0.0, -1.0], [0.0, 1.0]);
        let ids: Vec<u32> = scene.all_touched(&ray).map(|hit: Hit| hit.primitive_id).collect();
        assert_eq!(ids, (0..40).collect::<Vec<_>>(), "{strategy:?}");
    }
}
