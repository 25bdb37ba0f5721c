//! An f64 mesh in a plane x = 1e300 whose other coordinates are 1e-100: made larger, so that its differences can be
//! multiplied, its x overflowed, and distances and solid angles were of NaN.

use kdray::{BuildOptions, Scene, Side, TriangleMesh};
use kdray_tests::meshes::Soup;

/// Two triangles over one another, in the plane at x.
fn sheets(x: f64, size: f64) -> Soup<f64> {
    let sheet = |corners: [[f64; 2]; 3]| corners.map(|[y, z]| [x, size * y, size * z]);
    vec![sheet([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]]), sheet([[-1.0, -1.0], [5.0, 0.0], [0.0, 5.0]])]
}

fn scene(soup: Soup<f64>) -> Scene<f64> {
    let mesh = TriangleMesh::from_soup(soup).expect("finite");
    Scene::build(mesh, &BuildOptions::default()).expect("a small mesh")
}

const FAR: [f64; 4] = [1e300, -1e300, f64::MAX, 3e250];
const SIZES: [f64; 4] = [1e-100, 1e-300, 1e-70, 1e-40];

#[test]
fn points_of_the_plane_are_answered_as_elsewhere() {
    for (far, size) in FAR.into_iter().flat_map(|far| SIZES.map(|size| (far, size))) {
        let (there, here) = (scene(sheets(far, size)), scene(sheets(0.0, size)));
        for (y, z) in [(1.0, 1.0), (-3.0, 1.0), (7.0, 7.0), (0.0, 1e50), (0.0, 0.0)] {
            let at = |x: f64| [x, size * y, size * z];
            let found = there.closest_point(at(far)).unwrap();
            let expected = here.closest_point(at(0.0)).unwrap();
            assert_eq!(found.distance, expected.distance, "{far}, {size}: {y}, {z}");
            let [_, y, z] = expected.point;
            assert_eq!(found.point, [far, y, z]);
            assert_eq!(there.signed_distance(at(far)), Some(expected.distance));
            assert_eq!(there.winding_number(at(far)), 0.0);
            assert_eq!(there.contains(at(far)), expected.distance == 0.0);
        }
        for side in [Side::Front, Side::Back] {
            assert_eq!(there.thickness(0, 0.25, 0.25, side), Some(0.0), "{far}, {size}");
        }
    }
}

#[test]
fn points_elsewhere_are_as_far_as_the_plane() {
    for (far, size) in FAR.into_iter().flat_map(|far| SIZES.map(|size| (far, size))) {
        let scene = scene(sheets(far, size));
        let beside = if far > 0.0 { far.next_down() } else { far.next_up() };
        for x in [0.0, 0.5 * far, beside, size] {
            let point = [x, size, size];
            let found = scene.closest_point(point).unwrap();
            let expected = (far - x).abs();
            assert!((found.distance / expected - 1.0).abs() < 1e-12, "{far}, {size}: {x}");
            assert_eq!(found.point[0], far, "{far}, {size}: {x}");
            assert_eq!(scene.signed_distance(point), Some(found.distance));
            assert_eq!(scene.winding_number(point), 0.0, "{far}, {size}: {x}");
        }
    }
}

#[test]
fn specks_in_the_plane_leave_the_rest_as_it_is() {
    // A tetrahedron with one side open, and the sheets within.
    let corners = [[-1.0; 3], [1.5, 0.0, 0.0], [0.0, 1.5, 0.0], [0.0, 0.0, 1.5]];
    let large =
        [[0, 1, 3], [0, 3, 2], [1, 2, 3]].map(|f| f.map(|i: usize| corners[i].map(|x| x * 1e300)));
    let bare = scene(large.to_vec());
    for size in SIZES {
        let scene = scene([large.to_vec(), sheets(1e299, size)].concat());
        for point in [[1e299, -3.0 * size, 0.0], [1e299, 1e9 * size, -size], [1e299, 1e298, 0.0]] {
            assert!(scene.contains(point), "{size}: {point:?}");
            let (found, expected) = (scene.winding_number(point), bare.winding_number(point));
            assert!((found - expected).abs() < 1e-9, "{size}: {found} for {expected}");
        }
    }
}
