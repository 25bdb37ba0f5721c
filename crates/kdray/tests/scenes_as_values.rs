//! What programs do with scenes besides asking them: share them, catch panics around them, print them.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use kdray::{Arithmetic, BuildOptions, Instance, InstancedScene, KdTree, Ray, Scene, TriangleMesh};
use std::panic::{RefUnwindSafe, UnwindSafe, catch_unwind};

fn sheet(rows: u16) -> TriangleMesh {
    let corner = |x: u16, y: u16| [x, y, 0].map(f32::from);
    let triangle = |i: u16| {
        let (x, y) = (i % rows, i / rows);
        [corner(x, y), corner(x + 1, y), corner(x, y + 1)]
    };
    TriangleMesh::from_soup((0..rows * rows).map(triangle)).unwrap()
}

#[test]
fn they_can_be_shared_and_survive_panics() {
    const fn can_be_shared<T: Send + Sync + UnwindSafe + RefUnwindSafe>() {}
    can_be_shared::<Scene>();
    can_be_shared::<Scene<f64>>();
    can_be_shared::<InstancedScene>();
    can_be_shared::<TriangleMesh<f64>>();
    can_be_shared::<KdTree>();
    let scene = Scene::build(sheet(4), &BuildOptions::default()).unwrap();
    let ray = Ray::new([0.25, 0.25, 1.0], [0.0, 0.0, -1.0]);
    assert!(catch_unwind(|| scene.any_hit(&ray)).unwrap());
}

#[test]
fn hits_that_are_left_can_be_looked_at_twice() {
    let scene = Scene::build(sheet(4), &BuildOptions::default()).unwrap();
    let mut hits = scene.all_hits(&Ray::new([-0.5, 0.25, -0.5], [1.0, 0.0, 0.25]));
    let ahead = hits.clone().count();
    assert_eq!((ahead, hits.next().is_some(), hits.count()), (1, true, 0));
}

#[test]
fn they_are_printed_in_few_words() {
    let scene = Scene::build(sheet(100), &BuildOptions::default()).unwrap();
    let copies = InstancedScene::build(vec![scene.clone()], vec![Instance::of(0)]).unwrap();
    for printed in [format!("{scene:?}"), format!("{copies:?}")] {
        assert!(printed.contains("10000 items") && printed.len() < 5000, "{printed}");
    }
}

#[test]
fn weights_in_plain_floating_point_are_those_of_a_point_of_the_triangle() {
    let at = |z: f32| [[0.0, 0.0, z], [3.0, 0.0, z], [0.0, 3.0, z]];
    let mesh = TriangleMesh::from_soup([at(1.0), at(3.0)]).unwrap();
    let scene = Scene::build(mesh, &BuildOptions::default()).unwrap();
    let scene = scene.with_arithmetic(Arithmetic::Float);
    let mut hits = 0;
    for i in 1..2000 {
        // Along the longest side, where the third weight is next to nothing.
        let x = 3.0 * f64::from(i) / 2000.0;
        let y = 3.0 - x - f64::from(i % 7) * 1e-8;
        let Some(hit) = scene.closest_hit(&Ray::new([x, y, 0.0], [0.0, 0.0, 1.0])) else {
            continue;
        };
        hits += 1;
        assert!(hit.u >= 0.0 && hit.v >= 0.0 && hit.u + hit.v <= 1.0, "{hit:?}");
        assert_eq!(scene.thickness(hit.primitive_id, hit.u, hit.v, hit.side), Some(2.0));
    }
    assert!(hits > 500, "{hits}");
}
