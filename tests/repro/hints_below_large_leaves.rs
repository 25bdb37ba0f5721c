//! The parts of a leaf of 449 triangles or more are nodes with homes of their own, which had the whole leaf's cell. A
//! search that began at one of them never looked at the others.

use kdray::build::Preset;
use kdray::{BuildOptions, Ray, Scene};
use kdray_tests::meshes;
use kdray_tests::sets::by_each_set;

#[test]
fn what_other_parts_of_a_leaf_list_is_found_by_hints() {
    let at = |i: usize| [(i % 25) as f32, (i / 25) as f32, 0.0];
    let small = |i: usize| {
        let [x, y, z] = at(i);
        [[x, y, z], [x + 0.5, y, z], [x, y + 0.5, z]]
    };
    let one_leaf = BuildOptions { leaf_size: usize::MAX, ..BuildOptions::preset(Preset::Best) };
    let scene = Scene::build(meshes::mesh((0..500).map(small).collect()), &one_leaf).unwrap();
    let through = |i: usize| {
        let [x, y, _] = at(i).map(f64::from);
        Ray::new([x + 0.125, y + 0.125, -1.0], [0.0, 0.0, 1.0]).with_interval(0.0, 2.0)
    };
    for scene in by_each_set(&scene) {
        let (_, hint) = scene.closest_hit_with_hint(&through(0)).unwrap();
        for i in 0..500 {
            assert!(scene.any_hit_near(&through(i), hint), "{i}");
        }
    }
}
