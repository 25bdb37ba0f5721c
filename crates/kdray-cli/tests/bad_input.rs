//! The rows of docs/guide/bad-input.md: what the command does with each, and what it says.

mod support;

use std::{
    io::{Read, Write},
    process::{Command, Stdio},
};
use support::{
    Folder, INPUT, OCTAHEDRON, OUTPUT, USAGE, binary,
    rays::{csv, raw_npy, rays},
};

/// A ray down the z axis, at (1/4, 1/4), on standard input.
const RAY: &str = "0.25,0.25,5,0,0,-1\n";

/// Faces of three indices over vertices, as ASCII PLY.
fn ply(vertices: &[&str], faces: &[&str]) -> String {
    let (v, f) = (vertices.len(), faces.len());
    let faces: String = faces.iter().map(|face| format!("3 {face}\n")).collect();
    format!(
        "ply\nformat ascii 1.0\nelement vertex {v}\nproperty float x\nproperty float y\n\
         property float z\nelement face {f}\nproperty list uchar int vertex_indices\nend_header\n\
         {}\n{faces}",
        vertices.join("\n")
    )
}

/// The mode's answer for one ray as CSV, without the line of names.
fn answer(folder: &Folder, mesh: &str, mode: &str) -> String {
    let arguments = ["query", mesh, "--rays", "-", "--mode", mode, "--out", "-"];
    let csv = folder.kdray_reading(&arguments, RAY).succeeds().stdout;
    csv.split_once('\n').expect("a line of names").1.to_owned()
}

#[test]
fn an_empty_mesh_is_a_scene_that_nothing_hits() {
    let folder = Folder::new();
    folder.file("empty.ply", ply(&[], &[]));
    assert!(folder.kdray(&["stats", "empty.ply"]).succeeds().stderr.contains("no triangles"));
    let json = folder.kdray(&["stats", "empty.ply", "--json"]).succeeds().stdout;
    assert!(json.contains("\"sah_cost\": 0.0"), "{json}");
    folder.kdray(&["validate", "empty.ply"]).succeeds();
    assert!(answer(&folder, "empty.ply", "closest").starts_with("inf,4294967295,4294967295,"));
    assert_eq!(answer(&folder, "empty.ply", "count"), "0\n");
    folder.kdray(&["render", "empty.ply", "--size", "8x8", "--samples", "1"]).succeeds();
}

#[test]
fn one_triangle_is_a_scene() {
    let folder = Folder::new();
    folder.file("one.ply", ply(&["0 0 0", "1 0 0", "0 1 0"], &["0 1 2"]));
    folder.kdray(&["validate", "one.ply"]).succeeds();
    assert!(answer(&folder, "one.ply", "closest").starts_with("5.0,0,0,0.25,0.25,"));
    folder.kdray(&["render", "one.ply", "--size", "8x8", "--samples", "1"]).succeeds();
}

#[test]
fn of_identical_triangles_the_first_is_hit_and_all_are_crossed() {
    let folder = Folder::new();
    folder.file("same.ply", ply(&["0 0 0", "1 0 0", "0 1 0"], &["0 1 2"; 3000]));
    for split in ["sah", "middle", "median", "round-robin"] {
        folder.kdray(&["validate", "same.ply", "--split", split]).succeeds();
    }
    assert!(answer(&folder, "same.ply", "closest").starts_with("5.0,0,0,"));
    assert_eq!(answer(&folder, "same.ply", "count"), "3000\n");
}

#[test]
fn degenerate_triangles_are_kept_and_never_hit() {
    let folder = Folder::new();
    let vertices = ["0.25 0.25 0", "1 1 0", "0.25 0.25 0", "0 0 0"];
    folder.file("flat.ply", ply(&vertices, &["0 0 0", "0 1 3", "0 2 1"]));
    let stats = folder.kdray(&["stats", "flat.ply", "--json"]).succeeds().stdout;
    assert!(stats.contains("\"triangles\": 3"), "{stats}");
    folder.kdray(&["validate", "flat.ply"]).succeeds();
    assert_eq!(answer(&folder, "flat.ply", "count"), "0\n");
    assert_eq!(answer(&folder, "flat.ply", "any"), "false\n");
}

#[test]
fn non_finite_vertices_are_refused_or_dropped() {
    let folder = Folder::new();
    for bad in ["nan", "inf"] {
        let vertices = ["0 0 0", "1 0 0", "0 1 0", &format!("{bad} 0 0")];
        folder.file("bad.ply", ply(&vertices, &["0 1 2", "0 1 3"]));
        let ran = folder.kdray(&["stats", "bad.ply"]);
        ran.fails(INPUT, &["bad.ply", "face 1", "not finite"]);
        let ran = folder.kdray(&["stats", "bad.ply", "--drop-bad", "--json"]).succeeds();
        assert!(ran.stdout.contains("\"triangles\": 1"), "{}", ran.stdout);
        assert!(ran.stderr.contains("dropped"), "{}", ran.stderr);
    }
}

#[test]
fn indices_out_of_range_are_refused_or_dropped() {
    let folder = Folder::new();
    folder.file("bad.ply", ply(&["0 0 0", "1 0 0", "0 1 0"], &["0 1 2", "0 1 9"]));
    let ran = folder.kdray(&["stats", "bad.ply"]);
    ran.fails(INPUT, &["bad.ply", "face 1", "index 9", "3 vertices"]);
    let ran = folder.kdray(&["stats", "bad.ply", "--drop-bad", "--json"]).succeeds();
    assert!(ran.stdout.contains("\"triangles\": 1"), "{}", ran.stdout);
    assert!(ran.stderr.contains("dropped"), "{}", ran.stderr);
}

#[test]
fn rays_that_cannot_be_traced_miss_and_are_counted() {
    let folder = Folder::new();
    folder.file("ball.off", OCTAHEDRON);
    let rays = "0,0,5,0,0,0\n0,0,5,0,0,-1\nnan,0,5,0,0,-1\n0,0,5,0,inf,-1\n";
    for naive in [&[][..], &["--naive"]] {
        let arguments = ["query", "ball.off", "--rays", "-", "--mode", "any", "--out", "-"];
        let ran = folder.kdray_reading(&[&arguments, naive].concat(), rays).succeeds();
        assert_eq!(ran.stdout, "occluded\nfalse\ntrue\nfalse\nfalse\n");
        let warning =
            "3 of 4 rays cannot be traced and count as misses; ray 0: the ray's direction";
        assert!(ran.stderr.contains(warning), "{}", ran.stderr);
    }
}

#[test]
fn an_interval_that_is_no_number_is_a_miss_with_a_warning() {
    let folder = Folder::new();
    folder.file("ball.off", OCTAHEDRON);
    let rays = "0,0,5,0,0,-1,nan,9\n0,0,5,0,0,-1,0,nan\n0,0,5,0,0,-1,0,inf\n";
    let arguments = ["query", "ball.off", "--rays", "-", "--mode", "any", "--out", "-"];
    let ran = folder.kdray_reading(&arguments, rays).succeeds();
    assert_eq!(ran.stdout, "occluded\nfalse\nfalse\ntrue\n");
    assert!(ran.stderr.contains("2 of 3 rays cannot be traced"), "{}", ran.stderr);
}

#[test]
fn an_empty_interval_is_a_miss_without_a_warning() {
    let folder = Folder::new();
    folder.file("ball.off", OCTAHEDRON);
    let rays = "0,0,5,0,0,-1,4,6\n0,0,5,0,0,-1,6,4\n";
    let arguments = ["query", "ball.off", "--rays", "-", "--mode", "any", "--out", "-"];
    let ran = folder.kdray_reading(&arguments, rays).succeeds();
    assert_eq!(ran.stdout, "occluded\ntrue\nfalse\n");
    assert!(!ran.stderr.contains("warning"), "{}", ran.stderr);
}

#[test]
fn a_camera_needs_a_direction_and_an_angle() {
    let folder = Folder::new();
    folder.file("ball.off", OCTAHEDRON);
    let cases: [(&[&str], &str); 4] = [
        (&["--eye", "1,1,1", "--look-at", "1,1,1"], "the same"),
        (&["--eye", "0,5,0", "--look-at", "0,0,0", "--up", "0,1,0"], "parallel to the view"),
        (&["--fov", "180"], "between 0 and 180"),
        (&["--eye", "1,1"], "give 3 numbers"),
    ];
    for (arguments, part) in cases {
        folder.kdray(&[&["render", "ball.off"], arguments].concat()).fails(USAGE, &[part]);
    }
    for option in ["--fov", "--occlusion-distance", "--heat-max", "--exposure"] {
        let refused = folder.kdray(&["render", "gone.off", option, "0"]);
        refused.fails(USAGE, &[&format!("invalid value '0' for '{option}")]);
    }
    assert_eq!(folder.names(), ["ball.off"]);
}

#[test]
fn a_picture_needs_pixels() {
    let folder = Folder::new();
    for size in ["0x8", "8x0", "8", "99999999x99999999"] {
        folder.kdray(&["render", "--size", size]).fails(USAGE, &["--size", size]);
    }
    let large = ["draw", "gone.off", "-o", "a.png", "--size", "16384x16384"];
    folder.kdray(&large).fails(USAGE, &["--size 16384x16384", ".svg"]);
    // Such a slice may be as flat as the mesh.
    folder.kdray(&[&large[..], &["--slice", "z=0"]].concat()).fails(INPUT, &["gone.off"]);
    assert!(folder.names().is_empty());
}

#[test]
fn a_missing_texture_or_material_library_is_a_warning() {
    let folder = Folder::new();
    let mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
    folder.file("texture.obj", format!("mtllib m.mtl\n{mesh}"));
    folder.file("library.obj", format!("mtllib gone.mtl\n{mesh}"));
    folder.file("m.mtl", "newmtl m\nmap_Kd gone.png\n");
    for (file, missing) in [("texture.obj", "gone.png"), ("library.obj", "gone.mtl")] {
        let ran = folder.kdray(&["stats", file]).succeeds();
        assert!(ran.stderr.contains("warning:"), "{}", ran.stderr);
        assert!(ran.stderr.contains(missing), "{}", ran.stderr);
        assert!(ran.stderr.contains("left out"), "{}", ran.stderr);
    }
}

#[test]
fn an_output_that_cannot_be_written_is_refused_before_the_work() {
    let folder = Folder::new();
    folder.file("ball.off", OCTAHEDRON);
    folder.file("rays.csv", RAY);
    std::fs::create_dir(folder.path("folder.png")).unwrap();
    for out in ["gone/x.png", "folder.png"] {
        let ran = folder.kdray(&["render", "ball.off", "-o", out]).fails(OUTPUT, &[out]);
        assert!(!ran.stderr.contains("read"), "it has read the scene: {}", ran.stderr);
    }
    let ran = folder.kdray(&["query", "ball.off", "--rays", "rays.csv", "--out", "gone/x.npz"]);
    let ran = ran.fails(OUTPUT, &["gone/x.npz: cannot be written: No such file"]);
    assert!(!ran.stderr.contains("read"), "it has read the scene: {}", ran.stderr);
    folder.kdray(&["render", "ball.off", "-o", "x.jpg"]).fails(USAGE, &["x.jpg", ".png or .exr"]);
}

#[test]
fn truncated_files_are_refused_by_place() {
    let folder = Folder::new();
    let whole = ply(&["0 0 0", "1 0 0", "0 1 0"], &["0 1 2", "0 2 1"]);
    folder.file("cut.ply", &whole[..whole.len() - 7]);
    folder.kdray(&["stats", "cut.ply"]).fails(INPUT, &["cut.ply", "face 1"]);
    folder.file("cut.off", &OCTAHEDRON[..60]);
    folder.kdray(&["render", "cut.off"]).fails(INPUT, &["cut.off"]);
}

#[test]
fn what_is_not_there_or_no_scene_is_refused() {
    let folder = Folder::new();
    folder.file("hello.txt", "hello");
    folder.kdray(&["stats", "gone.ply"]).fails(INPUT, &["gone.ply", "cannot be read"]);
    folder.kdray(&["stats", "hello.txt"]).fails(INPUT, &["hello.txt", "format"]);
    folder.kdray(&["stats", "."]).fails(INPUT, &["directory"]);
}

#[test]
fn a_tree_that_does_not_fit_in_memory_is_refused_beforehand() {
    let folder = Folder::new();
    folder.file("octahedron.off", OCTAHEDRON);
    let render = ["render", "octahedron.off", "--size", "8x8", "--samples", "1"];
    let limited = |limit| folder.kdray(&[&render[..], &["--memory-limit", limit]].concat());
    limited("1MB").fails(INPUT, &["the build needs about 0.0011 GB", "--memory-limit"]);
    assert!(folder.names().iter().all(|name| !name.ends_with(".png")), "nothing is left");
    limited("2MiB").succeeds();
    limited("none").succeeds();
    limited("8 giants").fails(USAGE, &["`8 giants` is no size", "such as 8GiB or 500MB, or none"]);
    let compare = ["compare", "octahedron.off", "--rays", "9", "--memory-limit", "1MB"];
    folder.kdray(&compare).fails(INPUT, &["memory"]);
}

#[test]
fn standard_input_without_end_is_refused_at_its_limit() {
    let folder = Folder::new();
    let arguments = ["stats", "-", "--format", "obj", "--max-bytes", "1MB"];
    let ran = fed_without_end(&folder, &arguments, b"v 0 0 0\n");
    assert_eq!(ran.0, Some(INPUT), "{}", ran.1);
    assert!(ran.1.contains("standard input: longer than the limit of 1000000 bytes"), "{}", ran.1);
    folder.kdray(&["stats", "-"]).fails(USAGE, &["--format"]);
}

#[test]
fn a_line_of_rays_without_end_is_refused() {
    let folder = Folder::new();
    folder.file("ball.off", OCTAHEDRON);
    let arguments = ["query", "ball.off", "--rays", "-", "--out", "hits.npz"];
    let ran = fed_without_end(&folder, &arguments, &[b'1'; 64]);
    assert_eq!(ran.0, Some(INPUT), "{}", ran.1);
    assert!(ran.1.contains("line 1: longer than 65536 bytes"), "{}", ran.1);
    assert_eq!(folder.names(), ["ball.off"]);
}

/// Runs the command on the same bytes over and over; its exit code and what it said.
fn fed_without_end(folder: &Folder, arguments: &[&str], bytes: &[u8]) -> (Option<i32>, String) {
    let mut command = Command::new(binary());
    command.args(arguments).current_dir(folder.path(""));
    command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the command runs");
    let mut stdin = child.stdin.take().expect("a pipe");
    let block = bytes.repeat(1024);
    // Ends with a broken pipe when the command has had enough.
    while stdin.write_all(&block).is_ok() {}
    let mut said = String::new();
    child.stderr.take().expect("a pipe").read_to_string(&mut said).expect("text");
    (child.wait().expect("an end").code(), said)
}

#[test]
fn files_that_hold_no_rays_are_refused_by_place() {
    let folder = Folder::new();
    folder.file("ball.off", OCTAHEDRON);
    let cases: [(&str, Vec<u8>, &[&str]); 15] = [
        ("scene.json", b"{\n  \"asset\": {}\n}\n".to_vec(), &["line 1", "has 1 numbers", "6"]),
        ("five.csv", b"1,2,3,4,5\n".to_vec(), &["line 1", "has 5 numbers"]),
        ("uneven.csv", b"1,2,3,4,5,6\n\n1,2,3\n".to_vec(), &["line 3", "has 3 numbers"]),
        ("word.csv", b"1,2,3,4,5,6\n1,2,x,4,5,6\n".to_vec(), &["line 2", "`x` is not a number"]),
        ("bytes.csv", b"1,2,3,4,5,6\n\xff\xfe,2,3,4,5,6\n".to_vec(), &["line 2", "not text"]),
        ("seven.npy", raw_npy("'<f4'", "(1, 7)", &[0; 28]), &["shape (1, 7)", "N x 6"]),
        ("flat.npy", raw_npy("'<f4'", "(6,)", &[0; 24]), &["shape (6,)"]),
        ("whole.npy", raw_npy("'<i8'", "(1, 6)", &[0; 48]), &["dtype '<i8'"]),
        ("object.npy", raw_npy("'|O'", "(1, 6)", &[0; 48]), &["dtype '|O'"]),
        ("cut.npy", raw_npy("'<f8'", "(9, 6)", &[0; 100]), &["row 2", "9 rows", "truncated"]),
        ("huge.npy", raw_npy("'<f8'", "(72057594037927935, 6)", &[]), &["row 0", "truncated"]),
        ("more.npy", raw_npy("'<f8'", "(99999999999999999999, 6)", &[]), &["shape"]),
        ("keys.npy", raw_npy("'<f8', 'x': (", "(1, 6)", &[0; 48]), &[]),
        ("magic.npy", b"\x93NUMPY".to_vec(), &["header", "ends"]),
        ("version.npy", b"\x93NUMPY\x09\x00aaaa".to_vec(), &["version 9"]),
    ];
    for (name, bytes, parts) in cases {
        folder.file(name, bytes);
        let ran = folder.kdray(&["query", "ball.off", "--rays", name, "--out", "hits.npz"]);
        if parts.is_empty() {
            ran.succeeds();
            std::fs::remove_file(folder.path("hits.npz")).unwrap();
        } else {
            ran.fails(INPUT, &[&[name], parts].concat());
        }
    }
    assert!(!folder.names().iter().any(|name| name.contains("hits") || name.contains(".part")));
}

#[test]
fn a_stream_that_breaks_off_is_refused() {
    let folder = Folder::new();
    folder.file("ball.off", OCTAHEDRON);
    let cut = raw_npy("'<f8'", "(9, 6)", &[0; 100]);
    let arguments = ["query", "ball.off", "--rays", "-", "--out", "hits.npz"];
    folder.kdray_reading(&arguments, cut).fails(INPUT, &["-: row 2", "9 rows"]);
    let fortran = raw_npy("'<f8'", "(1, 6)", &[0; 48]);
    let fortran = String::from_utf8_lossy(&fortran[10..]).replace("False, 's", "True, 's");
    let length = (fortran.len() as u16 - 48).to_le_bytes();
    let fortran = [b"\x93NUMPY\x01\x00", &length[..], fortran.as_bytes()].concat();
    folder.kdray_reading(&arguments, fortran).fails(INPUT, &["Fortran order"]);
    assert_eq!(folder.names(), ["ball.off"]);
}

#[test]
fn a_reader_that_stops_reading_is_no_error() {
    let folder = Folder::new();
    folder.file("ball.off", OCTAHEDRON);
    folder.file("rays.csv", csv(&rays(50_000, 6)));
    let mut command = Command::new(binary());
    command.args(["query", "ball.off", "--rays", "rays.csv", "--out", "-", "--quiet"]);
    command.current_dir(folder.path("")).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the command runs");
    let mut start = [0; 10];
    child.stdout.take().expect("a pipe").read_exact(&mut start).expect("a line");
    let output = child.wait_with_output().expect("an end");
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
}
