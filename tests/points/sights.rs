//! What is seen from a point: other points, and the next surface.

use super::*;

#[test]
fn points_see_each_other_where_rational_arithmetic_says_so() {
    sights_are_rational(awkward_meshes());
    sights_are_rational(awkward_meshes_in_f64());
}

fn sights_are_rational<T: Precision>(meshes: Vec<(&str, TriangleMesh<T>)>) {
    let (mut seen, mut hidden) = (0, 0);
    for (name, mesh) in meshes {
        if T::FITS_TREE && ["empty", "huge", "tiny"].contains(&name) {
            continue;
        }
        let scene = scene(mesh.clone());
        let mut archer = Archer::new(&mesh, 61);
        for (index, ray) in archer.all_kinds(8, 10.0).into_iter().enumerate() {
            // Half of them on a grid that is fine enough to meet surfaces; the others are such that the way between
            // them is rounded.
            let placed =
                |p: [f64; 3]| if index % 2 == 0 { p.map(|x| archer.rounded(x)) } else { p };
            let (from, to) = (placed(ray.origin), placed(ray.at(1.0)));
            let way = (0..3).map(|k| to[k] - from[k]);
            if !way.chain(from).chain(to).all(f64::is_finite) {
                continue;
            }
            let expected = is_exactly_visible(&mesh, from, to);
            assert_eq!(scene.visible(from, to), expected, "{name} {from:?} {to:?}");
            assert_eq!(scene.visible(to, from), expected, "{name} {to:?} {from:?}");
            *(if expected { &mut seen } else { &mut hidden }) += 1;
        }
    }
    assert!(seen > 100 && hidden > 100, "{seen} seen, {hidden} hidden");
}

#[test]
fn a_box_is_as_thick_as_it_is_long() {
    // Not at zero, so that points on it are rounded.
    let moved = boxes(1).into_iter().map(|t| t.map(|p| p.map(|x| 0.1 + 3.0 * x)));
    let mesh = mesh(moved.collect());
    let scene = scene(mesh.clone());
    for id in 0..12 {
        let normal = mesh.geometric_normal(id);
        let [a, _, _] = corners(&mesh, id);
        let outward: f64 = (0..3).map(|k| normal[k] * (a[k] - 1.6)).sum();
        let sides = [Side::Front, Side::Back];
        let [outside, inside] = if outward > 0.0 { sides } else { [sides[1], sides[0]] };
        let found = scene.thickness(id, 0.3, 0.3, outside).expect("a box is closed");
        assert!((found - 3.0).abs() < 1e-6, "{id}: {found}");
        assert_eq!(scene.thickness(id, 0.3, 0.3, inside), None, "{id}");
    }
}

#[test]
fn neighbours_at_an_edge_or_a_corner_are_not_met_at_the_start() {
    let round = sphere(20);
    let moved = round.vertices().iter().map(|p| p.map(|x| 0.1 + 3.0 * x)).collect();
    thick_at_the_rims(&TriangleMesh::new(moved, round.triangles().to_vec()).unwrap(), (1.0, 7));
    let scaled = |by: f64| move |p: [f64; 3]| p.map(|x| (0.1 + 3.0 * x) * by);
    for size in [1e-300, 1.0, 1e290] {
        thick_at_the_rims(&self::moved(&round, scaled(size)), (size, 97));
    }
}

fn thick_at_the_rims<T: Precision>(round: &TriangleMesh<T>, (size, step): (f64, usize)) {
    let scene = scene(round.clone());
    let places = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.3, 0.0), (0.0, 0.6), (0.3, 0.7)];
    for id in (0..round.triangles().len() as u32).step_by(step) {
        for (u, v) in places {
            let found = scene.thickness(id, u, v, Side::Front).expect("a sphere is closed");
            assert!((5.5..6.1).contains(&(found / size)), "{id} {u} {v}: {found}");
            assert_eq!(scene.thickness(id, u, v, Side::Back), None, "{id} {u} {v}");
        }
    }
}

#[test]
fn a_hit_and_a_nearest_point_tell_where_to_measure() {
    let scene = scene(sphere(30));
    let ray = Ray::through([3.0, 1.0, 0.5], [0.1, 0.0, 0.0]);
    let hit = scene.closest_hit(&ray).expect("the sphere is ahead");
    let near = scene.closest_point(ray.origin).expect("there is a sphere");
    let thick = scene.thickness(hit.primitive_id, hit.u, hit.v, hit.side).expect("it is closed");
    let from_near = scene.thickness(near.primitive_id, near.u, near.v, Side::Front);
    assert!((thick - 2.0).abs() < 0.1, "{thick}");
    assert!((from_near.expect("it is closed") - 2.0).abs() < 0.1, "{from_near:?}");
}
