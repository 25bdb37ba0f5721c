//! `kdray query --points`: every mode, format and precision, and what is refused.

mod support;

use npyz::Order;
use std::fs;
use support::{
    Folder, INPUT, OCTAHEDRON, USAGE, bumpy_ball,
    hits::Npz,
    rays::{csv, npy, raw_npy, rays},
};

const MODES: [&str; 4] = ["closest-point", "contains", "signed-distance", "winding-number"];

fn folder() -> Folder {
    let folder = Folder::new();
    folder.file("ball.off", OCTAHEDRON);
    folder
}

/// The answers for points on standard input, as CSV.
fn answers(folder: &Folder, mode: &str, points: &str) -> String {
    let arguments = ["query", "ball.off", "--points", "-", "--mode", mode, "--out", "-"];
    folder.kdray_reading(&arguments, points).succeeds().stdout
}

#[test]
fn each_mode_has_its_columns() {
    let folder = folder();
    // In the middle, on a face, off a vertex, off an edge.
    let points = "x,y,z\n0,0,0\n0.25,0.25,0.5\n3,0,0\n0,-1,-1\n";
    let names = "points_x,points_y,points_z,distances,geometry_ids,primitive_ids,\
                 primitive_uvs_u,primitive_uvs_v,\
                 primitive_normals_x,primitive_normals_y,primitive_normals_z\n";
    let nearest = answers(&folder, "closest-point", points);
    let lines: Vec<&str> = nearest.strip_prefix(names).expect("the names").lines().collect();
    let third = 1.0 / 3.0_f64.sqrt();
    assert!(lines[1].starts_with("0.25,0.25,0.5,0.0,0,0,0.25,0.5,"), "{}", lines[1]);
    assert!(lines[2].starts_with("1.0,0.0,0.0,2.0,0,0,0.0,0.0,"), "{}", lines[2]);
    assert!(lines[2].ends_with(&format!(",{third},{third},{third}")), "{}", lines[2]);
    let distance = lines[3].split(',').nth(3).expect("a distance").parse::<f64>();
    assert!((distance.expect("a number") - 0.5_f64.sqrt()).abs() < 1e-15, "{}", lines[3]);

    assert_eq!(answers(&folder, "contains", points), "inside\ntrue\ntrue\nfalse\nfalse\n");
    let signed = answers(&folder, "signed-distance", points);
    let signed: Vec<&str> = signed.lines().collect();
    assert_eq!((signed[0], signed[2], signed[3]), ("signed_distances", "0.0", "2.0"));
    assert!((signed[1].parse::<f64>().expect("a number") + third).abs() < 1e-15, "{}", signed[1]);
    let winding = answers(&folder, "winding-number", points);
    let winding: Vec<&str> = winding.lines().collect();
    assert_eq!((winding[0], winding[1], winding[3]), ("winding_numbers", "1.0", "0.0"));
    assert!((winding[2].parse::<f64>().expect("a number") - 0.5).abs() < 0.01, "{}", winding[2]);
}

#[test]
fn arrays_are_named_typed_and_shaped() {
    let folder = folder();
    let points = [vec![0.0, 0.0, 0.0], vec![3.0, 0.0, 0.0], vec![f64::NAN, 0.0, 0.0]];
    folder.file("points.npy", npy(&points, Order::C, |x| x as f32));
    let read = |mode: &str| {
        let arguments =
            ["query", "ball.off", "--points", "points.npy", "--mode", mode, "--out", "a.npz"];
        let ran = folder.kdray(&arguments).succeeds();
        let warning = "1 of 3 points are not finite and have no answer; point 2: a coordinate";
        assert!(ran.stderr.contains(warning), "{}", ran.stderr);
        Npz::read(&folder.path("a.npz"))
    };
    let nearest = read("closest-point");
    let names = [
        "points",
        "distances",
        "geometry_ids",
        "primitive_ids",
        "primitive_uvs",
        "primitive_normals",
    ];
    assert_eq!(nearest.names(), names);
    let (places, shape) = nearest.array::<f32>("points");
    assert_eq!((&places[3..], shape), (&[1.0, 0.0, 0.0, 0.0, 0.0, 0.0][..], vec![3, 3]));
    assert_eq!(nearest.numbers::<f32>("distances")[1..], [2.0, f32::INFINITY]);
    assert_eq!(nearest.numbers::<u32>("geometry_ids"), [0, 0, u32::MAX]);
    assert_eq!(nearest.numbers::<u32>("primitive_ids"), [0, 0, u32::MAX]);
    assert_eq!(nearest.array::<f32>("primitive_uvs").1, [3, 2]);
    assert_eq!(nearest.numbers::<f32>("primitive_normals")[6..], [0.0; 3]);
    let inside = read("contains");
    assert_eq!(inside.array::<bool>("inside"), (vec![true, false, false], vec![3]));
    let signed = read("signed-distance").numbers::<f32>("signed_distances");
    assert_eq!((signed[0] < 0.0, signed[1], signed[2]), (true, 2.0, f32::INFINITY));
    let winding = read("winding-number").numbers::<f32>("winding_numbers");
    assert_eq!(winding[..2], [1.0, 0.0]);
    assert!(winding[2].is_nan());
}

#[test]
fn neither_the_form_of_the_points_nor_tree_nor_threads_matter() {
    let folder = Folder::new();
    folder.file("ball.off", bumpy_ball(15, 20));
    let points: Vec<Vec<f64>> = rays(70_000, 6).into_iter().map(|ray| ray[..3].to_vec()).collect();
    folder.file("c.npy", npy(&points, Order::C, |x| x));
    folder.file("fortran.npy", npy(&points, Order::Fortran, |x| x));
    folder.file("points.csv", csv(&points));
    for mode in MODES {
        let query = |file: &str, out: &str, more: &[&str]| {
            let arguments = ["query", "ball.off", "--points", file, "--mode", mode, "--out", out];
            let ran = folder.kdray(&[&arguments, more].concat()).succeeds();
            assert!(ran.stderr.contains("answered 70000 points"), "{}", ran.stderr);
            fs::read(folder.path(out)).unwrap()
        };
        let expected = query("c.npy", "expected.npz", &[]);
        assert!(query("fortran.npy", "a.npz", &["--threads", "3"]) == expected, "{mode}");
        assert!(query("points.csv", "a.npz", &["--split", "median"]) == expected, "{mode}");
    }
}

#[test]
fn the_nearest_point_is_asked_for_if_nothing_is_said() {
    let folder = folder();
    let arguments = ["query", "ball.off", "--points", "-", "--out", "-"];
    let csv = folder.kdray_reading(&arguments, "3,0,0\n").succeeds().stdout;
    assert_eq!(csv, answers(&folder, "closest-point", "3,0,0\n"));
}

#[test]
fn no_points_make_empty_arrays() {
    let folder = folder();
    folder.file("none.npy", raw_npy("'<f8'", "(0, 3)", &[]));
    folder.kdray(&["query", "ball.off", "--points", "none.npy", "--out", "a.npz"]).succeeds();
    let nearest = Npz::read(&folder.path("a.npz"));
    assert_eq!(nearest.array::<f64>("points"), (vec![], vec![0, 3]));
    assert_eq!(nearest.array::<f64>("distances"), (vec![], vec![0]));
}

#[test]
fn an_empty_mesh_is_near_nothing() {
    let folder = Folder::new();
    folder.file("ball.off", "OFF\n0 0 0\n");
    assert!(
        answers(&folder, "closest-point", "1,2,3\n")
            .contains("\n0.0,0.0,0.0,inf,4294967295,4294967295,0.0,0.0,0.0,0.0,0.0\n")
    );
    assert_eq!(answers(&folder, "contains", "1,2,3\n"), "inside\nfalse\n");
    assert_eq!(answers(&folder, "signed-distance", "1,2,3\n"), "signed_distances\ninf\n");
    assert_eq!(answers(&folder, "winding-number", "1,2,3\n"), "winding_numbers\n0.0\n");
}

#[test]
fn files_that_hold_no_points_are_refused_by_place() {
    let folder = folder();
    folder.file("rays.npy", npy(&rays(2, 6), Order::C, |x| x));
    folder.file("whole.npy", raw_npy("'<i8'", "(1, 3)", &[0; 24]));
    folder.file("rays.csv", csv(&rays(2, 6)));
    folder.file("word.csv", "1,2,3\n1,x,3\n");
    for (file, parts) in [
        ("rays.npy", &["shape (2, 6,): points must be N x 3 (x, y, z)"][..]),
        ("whole.npy", &["dtype '<i8': points must be 32- or 64-bit floats"]),
        ("rays.csv", &["line 1: has 6 numbers; give 3 (x, y, z), with commas between"]),
        ("word.csv", &["line 2: `x` is not a number"]),
        ("gone.csv", &["gone.csv: cannot be read"]),
    ] {
        let ran = folder.kdray(&["query", "ball.off", "--points", file, "--out", "a.npz"]);
        ran.fails(INPUT, &[&[file][..], parts].concat());
    }
    assert!(!folder.names().contains(&"a.npz".to_owned()));
}

#[test]
fn modes_of_rays_and_points_do_not_mix() {
    let folder = folder();
    for mode in MODES {
        let ran = folder.kdray(&["query", "ball.off", "--rays", "-", "--mode", mode, "--out", "-"]);
        ran.fails(USAGE, &[&format!("--mode {mode} is asked of points; give them with --points")]);
    }
    for mode in ["closest", "any", "all", "count"] {
        let arguments = ["query", "ball.off", "--points", "-", "--mode", mode, "--out", "-"];
        let message = format!("--mode {mode} is asked of rays; give them with --rays");
        folder.kdray(&arguments).fails(USAGE, &[&message]);
    }
    folder.kdray(&["query", "ball.off", "--out", "-"]).fails(USAGE, &["--rays"]);
    let both = ["query", "ball.off", "--points", "-", "--rays", "-", "--out", "-"];
    folder.kdray(&both).fails(USAGE, &["--rays"]);
    let naive = ["query", "ball.off", "--points", "-", "--naive", "--out", "-"];
    folder.kdray(&naive).fails(USAGE, &["--naive"]);
    let stdin = ["query", "-", "--points", "-", "--out", "a.npz"];
    folder.kdray(&stdin).fails(USAGE, &["standard input cannot be both scene and points"]);
}
