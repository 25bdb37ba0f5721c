//! Meshes around points.

use kdray::TriangleMesh;
use kdray_tests::meshes::{
    boxes, degenerate, grid, mesh, mesh_in_f64, moved, needles, soup, sphere, torus,
};

pub(crate) fn awkward_meshes() -> Vec<(&'static str, TriangleMesh)> {
    let far = soup(80, [500_000.0, 5_400_000.0, 300.0], 20.0, 4);
    let huge = soup(40, [0.0; 3], 1e38, 5);
    let tiny = soup(40, [0.0; 3], 1e-38, 6);
    vec![
        ("empty", mesh(Vec::new())),
        ("soup", mesh(soup(120, [0.0; 3], 1.0, 3))),
        ("far from zero", mesh(far)),
        ("huge", mesh(huge)),
        ("tiny", mesh(tiny)),
        ("grid", mesh(grid(5, 3))),
        ("boxes", mesh(boxes(2))),
        ("needles", mesh(needles(60, 7))),
        ("degenerate", mesh(degenerate(8))),
        ("sphere", sphere(8)),
        ("torus", torus(10, 7)),
    ]
}

/// Where f32 would round: a place in a national grid.
const FAR: [f64; 3] = [500_000.0, 5_400_000.0, 300.0];

/// Vertices that need all digits of f64.
pub(crate) fn of_many_digits(p: [f64; 3]) -> [f64; 3] {
    p.map(|x| (x + 0.1) / 3.0)
}

/// Vertices of a small thing, far away.
pub(crate) fn far_away([x, y, z]: [f64; 3]) -> [f64; 3] {
    [FAR[0] + 0.01 * x, FAR[1] + 0.01 * y, FAR[2] + 0.01 * z]
}

/// Few, for all of f64.
pub(crate) fn awkward_meshes_in_f64() -> Vec<(&'static str, TriangleMesh<f64>)> {
    let small_soup = mesh(soup(60, [0.0; 3], 1.0, 13));
    vec![
        ("empty", TriangleMesh::default()),
        ("soup of many digits", moved(&small_soup, of_many_digits)),
        ("soup far from zero", moved(&small_soup, far_away)),
        ("huge", moved(&small_soup, |p| p.map(|x| x * 1e290))),
        ("tiny", moved(&small_soup, |p| p.map(|x| x * 1e-300))),
        ("of the smallest numbers", moved(&small_soup, |p| p.map(|x| x * 1e-317))),
        ("needles far from zero", moved(&mesh(needles(40, 17)), far_away)),
        ("degenerate", moved(&mesh(degenerate(18)), of_many_digits)),
        ("torus far from zero", moved(&torus(8, 5), far_away)),
        ("grid", mesh_in_f64(&mesh(grid(4, 2)))),
    ]
}

pub(crate) fn closed_meshes_in_f64() -> Vec<(&'static str, TriangleMesh<f64>)> {
    let mut all = Vec::new();
    for (name, mesh) in closed_meshes() {
        all.push((name, moved(&mesh, of_many_digits)));
        all.push((name, moved(&mesh, far_away)));
    }
    all.push(("huge", moved(&sphere(5), |p| p.map(|x| x * 1e290))));
    all.push(("tiny", moved(&sphere(5), |p| p.map(|x| x * 1e-300))));
    all
}

pub(crate) fn closed_meshes() -> Vec<(&'static str, TriangleMesh)> {
    // Two tetrahedra that share an edge, so that four triangles meet there.
    let [a, b] = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let tetrahedron = |c: [f32; 3], d: [f32; 3]| [[a, b, c], [a, d, b], [a, c, d], [b, d, c]];
    let hinged = [
        tetrahedron([1.0, 0.0, 0.3], [0.7, 0.6, 0.1]),
        tetrahedron([-1.0, 0.0, 0.3], [-0.7, -0.6, 0.1]),
    ];
    let mut nested = boxes(1);
    nested.extend(boxes(1).into_iter().map(|t| t.map(|p| p.map(|x| 0.25 + 0.5 * x))));
    vec![
        ("sphere", sphere(7)),
        ("torus", torus(9, 6)),
        ("a box", mesh(boxes(1))),
        ("boxes side by side", mesh(boxes(2))),
        ("hinged", mesh(hinged.concat())),
        ("nested", mesh(nested)),
    ]
}
