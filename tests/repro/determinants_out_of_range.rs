//! Copies of meshes made 10^103 times as large, or as small, were refused as flattened: the determinants of their
//! matrices, which are of the third power of that, over- or underflowed.

use kdray::{
    BuildOptions, Coordinate, Instance, InstancedScene, Precision, Ray, Scene, TriangleMesh,
};

/// A square from −1 to 1, made larger by `size`, which its copy undoes.
fn square<T: Precision>(size: f64) -> Scene<T> {
    let corner = |x: f64, y: f64| [x, y, 0.0].map(|x| <T as Coordinate>::from_f64(size * x));
    let vertices = vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let mesh = TriangleMesh::new(vertices, vec![[0, 1, 2], [0, 2, 3]]).expect("finite");
    Scene::build(mesh, &BuildOptions::default()).expect("a small mesh")
}

fn scaled(x: f64, y: f64, z: f64) -> [[f64; 4]; 3] {
    [[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], [0.0, 0.0, z, 2.0]]
}

#[test]
fn meshes_of_any_size_are_placed() {
    for exponent in [-1000, -700, -400, -345, 345, 400, 700, 1000] {
        let scale = 2.0_f64.powi(exponent);
        for to_world in [scaled(scale, scale, scale), scaled(-scale, scale, 4.0 * scale)] {
            let copy = Instance::of(0).placed(to_world);
            let scene = InstancedScene::build(vec![square::<f64>(1.0 / scale)], vec![copy]);
            let scene = scene.unwrap_or_else(|error| panic!("2^{exponent}: {error}"));
            let ray = |x: f64| Ray::new([x, 0.5, 9.0], [0.0, 0.0, -1.0]);
            let found = scene.closest_hit(&ray(0.25)).expect("a hit");
            // Twice the area of half of the square; a mirrored copy has the same front.
            let normal = scene.geometric_normal(&found);
            assert_eq!((found.hit.t, normal), (7.0, [0.0, 0.0, 4.0]), "2^{exponent}");
            assert_eq!(scene.closest_hit(&ray(1.25)), None, "2^{exponent}");
        }
    }
}

#[test]
fn what_is_flattened_is_still_refused() {
    for scale in [1e-200, 1e-110, 1.0, 1e110, 1e200] {
        let flat = Instance::of(0).placed(scaled(scale, scale, 0.0));
        assert!(InstancedScene::build(vec![square::<f64>(1.0)], vec![flat]).is_err(), "{scale}");
    }
    for bad in [0.0, f64::NAN, f64::INFINITY] {
        let bad = Instance::of(0).placed(scaled(bad, bad, bad));
        assert!(InstancedScene::build(vec![square::<f64>(1.0)], vec![bad]).is_err(), "{bad:?}");
    }
}

#[test]
fn f32_meshes_become_specks() {
    let speck = Instance::of(0).placed(scaled(1e-110, 1e-110, 1e-110));
    let scene = InstancedScene::build(vec![square::<f32>(1.0)], vec![speck]).unwrap();
    let ray = |x: f64| Ray::new([x * 1e-110, 0.5e-110, 9.0], [0.0, 0.0, -1.0]);
    let t = scene.closest_hit(&ray(0.25)).expect("a hit").hit.t;
    assert!((t - 7.0).abs() < 1e-12, "{t}");
    assert_eq!(scene.closest_hit(&ray(1.25)), None);
}
